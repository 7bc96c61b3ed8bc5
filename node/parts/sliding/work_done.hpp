// What a node has done in the picture, and when that is worth telling the frontal: where boundaries
// slide, the frontal decides by it, and sends tiles by it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "proto/messages.hpp"

namespace graycube {

class WorkDone {
 public:
  /// A node tells about so many times what it has done, for each ray that descends from one of its
  /// primary rays; and so many times as often while tiles of an older generation are open, which
  /// hold up the next slide.
  static constexpr std::uint64_t kTellings = 16, kOftener = 4;
  /// Rays that are never told of by themselves, and those that always are.
  static constexpr std::uint64_t kFewRays = 64, kManyRays = 4096;

  /// `primary_rays` that the node will have of the picture, if all nodes have as many.
  explicit WorkDone(std::uint64_t primary_rays)
      : rays_to_tell_(std::clamp(primary_rays / kTellings, kFewRays, kManyRays)) {}

  void assigned(std::uint32_t tiles, std::size_t waiting) {
    assigned_ += tiles;
    told_at_ = waiting / 2;
    is_due_ = true;
  }
  void add(double work, std::uint64_t rays) {
    work_ += work;
    rays_ += rays;
  }
  /// Whether the frontal is to be told, with `waiting` tiles still to be begun: now that half of
  /// those that were here are, new ones come before the node has none.
  bool is_worth_telling(std::size_t waiting, bool is_often) const {
    return (is_due_ && waiting <= told_at_) || has_many_rays(is_often);
  }
  /// Whether light that has gathered is to be sent, too: tiles become whole by it.
  bool has_many_rays(bool is_often) const {
    return rays_ >= (is_often ? std::max(rays_to_tell_ / kOftener, kFewRays) : rays_to_tell_);
  }
  bool has_news() const { return rays_ > 0; }
  control::Worked tell(std::uint32_t job, std::uint32_t epoch, std::size_t waiting) {
    told_at_ = waiting / 2;
    is_due_ = waiting > 0;
    rays_ = 0;
    return {job, epoch, static_cast<std::uint64_t>(work_),
            assigned_ - static_cast<std::uint32_t>(waiting)};
  }
  /// A new epoch.
  void reset() { *this = WorkDone(rays_to_tell_ * kTellings); }

 private:
  std::uint64_t rays_to_tell_;
  double work_ = 0;
  /// Rays traced since the frontal was told.
  std::uint64_t rays_ = 0;
  /// Tiles that came so far.
  std::uint32_t assigned_ = 0;
  /// The number of waiting tiles at which the frontal is told, if it hasn't been.
  std::size_t told_at_ = 0;
  bool is_due_ = false;
};

}  // namespace graycube
