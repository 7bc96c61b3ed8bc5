// Rays waiting for an evaluator: deepest first, so that trees stay narrow; or as they came, as in 1987.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "trace/ray_task.hpp"

namespace graycube {

class RayStore {
 public:
  /// Whether rays are taken as they came. The store must be empty.
  void set_fifo(bool fifo) { is_fifo_ = fifo; }
  /// `link`: the bit across which the ray came; its credit goes back there when the ray is taken.
  void add(const RayTask& ray, std::uint32_t link) {
    const std::size_t c = is_fifo_ ? 0 : depth_class(ray);
    if (c >= classes_.size()) classes_.resize(c + 1);
    classes_[c].push_back({ray, link});
    ++size_;
    if (c > deepest_) deepest_ = c;
  }

  /// Takes up to `most` of the deepest rays; `taken_from(link)` is called for each.
  template <typename TakenFrom>
  std::vector<RayTask> take(std::size_t most, TakenFrom&& taken_from) {
    std::vector<RayTask> rays;
    while (size_ > 0 && rays.size() < most) {
      while (classes_[deepest_].empty()) --deepest_;
      auto& held = classes_[deepest_];
      const Held& next = is_fifo_ ? held.front() : held.back();
      rays.push_back(next.ray);
      taken_from(next.link);
      is_fifo_ ? held.pop_front() : held.pop_back();
      --size_;
    }
    return rays;
  }

  bool is_empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() {
    classes_.clear();
    size_ = 0;
    deepest_ = 0;
  }

 private:
  struct Held {
    RayTask ray;
    std::uint32_t link;
  };
  /// A shadow ray is a leaf of its tree: deeper than the rays of its generation.
  static std::size_t depth_class(const RayTask& ray) {
    return std::size_t{2} * ray.depth + (ray.kind == RayKind::kShadow ? 1 : 0);
  }

  std::vector<std::deque<Held>> classes_;
  std::size_t size_ = 0;
  std::size_t deepest_ = 0;
  bool is_fifo_ = false;
};

}  // namespace graycube
