// Rays waiting for an evaluator. The deepest are taken first, so that trees stay narrow; or the
// oldest, as in 1987.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "trace/ray_task.hpp"

namespace graycube {

class RayStore {
 public:
  /// Whether rays are taken first come first served. The store must be empty.
  void set_fifo(bool fifo) { is_fifo_ = fifo; }
  /// `link`: the bit across which the rays came; their credit goes back there when they are taken.
  void add(std::span<const RayTask> rays, std::uint32_t link) {
    size_ += rays.size();
    if (is_fifo_) {
      for (const RayTask& ray : rays) line_.push_back({ray, link});
      return;
    }
    for_each_run(rays, level_of, [&](std::size_t level, std::span<const RayTask> run) {
      if (level >= levels_.size()) levels_.resize(level + 1);
      levels_[level].add(run, link);
      deepest_ = std::max(deepest_, level);
    });
  }

  /// Takes up to `most` of the deepest rays; `taken_from(link, count)` tells whence they came.
  template <typename TakenFrom>
  std::vector<RayTask> take(std::size_t most, TakenFrom&& taken_from) {
    std::vector<RayTask> taken;
    most = std::min(most, size_);
    taken.reserve(most);
    size_ -= most;
    while (is_fifo_ && taken.size() < most) {
      taken.push_back(line_.front().ray);
      taken_from(line_.front().link, std::size_t{1});
      line_.pop_front();
    }
    while (taken.size() < most) {
      while (levels_[deepest_].rays.empty()) --deepest_;
      levels_[deepest_].take(std::min(levels_[deepest_].rays.size(), most - taken.size()), taken,
                             taken_from);
    }
    return taken;
  }

  bool is_empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() {
    levels_.clear();
    line_.clear();
    size_ = 0;
    deepest_ = 0;
  }

 private:
  /// Rays of one kind and generation, and where each run of them came from.
  struct Level {
    struct Run {
      std::uint32_t link;
      std::size_t count;
    };
    std::vector<RayTask> rays;
    std::vector<Run> runs;

    void add(std::span<const RayTask> more, std::uint32_t link) {
      rays.insert(rays.end(), more.begin(), more.end());
      if (runs.empty() || runs.back().link != link) runs.push_back({link, 0});
      runs.back().count += more.size();
    }
    /// Moves the last `count` rays to `taken`.
    template <typename TakenFrom>
    void take(std::size_t count, std::vector<RayTask>& taken, TakenFrom& taken_from) {
      const auto first = rays.end() - static_cast<std::ptrdiff_t>(count);
      taken.insert(taken.end(), first, rays.end());
      rays.erase(first, rays.end());
      while (count > 0) {
        Run& run = runs.back();
        const std::size_t part = std::min(run.count, count);
        taken_from(run.link, part);
        count -= part;
        run.count -= part;
        if (run.count == 0) runs.pop_back();
      }
    }
  };
  struct Held {
    RayTask ray;
    std::uint32_t link;
  };
  /// A shadow ray is a leaf of its tree: deeper than the rays of its generation. Rays of one kind
  /// are traced together.
  static std::size_t level_of(const RayTask& ray) {
    constexpr std::size_t kOrder[kRayKinds] = {0, 3, 1, 2};
    return std::size_t{kRayKinds} * ray.depth + kOrder[static_cast<std::size_t>(ray.kind)];
  }

  std::vector<Level> levels_;
  /// All rays, where they are taken first come first served.
  std::deque<Held> line_;
  std::size_t size_ = 0;
  std::size_t deepest_ = 0;
  bool is_fifo_ = false;
};

}  // namespace graycube
