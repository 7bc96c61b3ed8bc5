#include "mesh/monotone_cut.hpp"

#include <deque>

namespace graycube {
namespace {

bool is_left_of(const FacePoint& a, const FacePoint& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// More than 0 if b, which lies between a and c from left to right, is above the line through
/// these; 0 if that line is upright.
double height_over(const FacePoint& a, const FacePoint& b, const FacePoint& c) {
  const double left = b.x - a.x, right = c.x - b.x;
  if (!(left + right > 0)) return 0;
  return (b.y - c.y) * left + (b.y - a.y) * right;
}

class Sweep {
 public:
  Sweep(std::span<const FacePoint> corners, std::vector<Triangle>& triangles)
      : corners_(corners), triangles_(triangles) {
    for (std::uint32_t i = 1; i < size(); ++i) {
      if (is_left_of(corners_[i], corners_[left_])) left_ = i;
      if (is_left_of(corners_[right_], corners_[i])) right_ = i;
    }
  }

  bool is_monotone() const {
    for (std::uint32_t i = left_; i != right_; i = next(i)) {
      if (!is_left_of(corners_[i], corners_[next(i)])) return false;
    }
    for (std::uint32_t i = right_; i != left_; i = next(i)) {
      if (!is_left_of(corners_[next(i)], corners_[i])) return false;
    }
    return true;
  }

  void run() {
    std::uint32_t low = previous(right_), high = next(right_);
    chain_ = {right_};
    while (low != high) {
      if (is_left_of(corners_[high], corners_[low])) {
        pass_low(low);
        low = previous(low);
      } else {
        pass_high(high);
        high = next(high);
      }
    }
    for (std::size_t i = 1; i < chain_.size(); ++i)
      triangles_.push_back({left_, chain_[i - 1], chain_[i]});
  }

 private:
  std::uint32_t size() const { return static_cast<std::uint32_t>(corners_.size()); }
  std::uint32_t next(std::uint32_t i) const { return (i + 1) % size(); }
  std::uint32_t previous(std::uint32_t i) const { return (i + size() - 1) % size(); }

  void pass_low(std::uint32_t corner) {
    while (chain_.size() > 1) {
      const FacePoint &near = corners_[chain_[0]], &far = corners_[chain_[1]];
      if (is_left_of(near, far) && height_over(corners_[corner], near, far) > 0) break;
      triangles_.push_back({corner, chain_[0], chain_[1]});
      chain_.pop_front();
    }
    chain_.push_front(corner);
  }

  void pass_high(std::uint32_t corner) {
    while (chain_.size() > 1) {
      const std::uint32_t last = chain_.back(), before = chain_[chain_.size() - 2];
      const FacePoint &near = corners_[last], &far = corners_[before];
      if (is_left_of(near, far) && height_over(corners_[corner], near, far) < 0) break;
      triangles_.push_back({before, last, corner});
      chain_.pop_back();
    }
    chain_.push_back(corner);
  }

  std::span<const FacePoint> corners_;
  std::vector<Triangle>& triangles_;
  std::uint32_t left_ = 0, right_ = 0;
  /// Corners that were passed and are not cut off yet, from the lower side to the upper one. All
  /// but its left end lie on one side of the polygon.
  std::deque<std::uint32_t> chain_;
};

}  // namespace

bool cut_monotone(std::span<const FacePoint> corners, std::vector<Triangle>& triangles) {
  Sweep sweep(corners, triangles);
  if (!sweep.is_monotone()) return false;
  sweep.run();
  return true;
}

}  // namespace graycube
