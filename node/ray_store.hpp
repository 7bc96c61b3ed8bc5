// Rays waiting for an evaluator: deepest first, so that trees stay narrow; or as they came, as in 1987.
#pragma once

#include <algorithm>
#include <cstddef>
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
    ++size_;
    if (is_fifo_) return line_.push_back({ray, link});
    const std::size_t c = depth_class(ray);
    if (c >= classes_.size()) classes_.resize(c + 1);
    classes_[c].rays.push_back(ray);
    classes_[c].links.push_back(link);
    if (c > deepest_) deepest_ = c;
  }

  /// Takes up to `most` of the deepest rays; `taken_from(link)` is called for each.
  template <typename TakenFrom>
  std::vector<RayTask> take(std::size_t most, TakenFrom&& taken_from) {
    std::vector<RayTask> taken;
    most = std::min(most, size_);
    taken.reserve(most);
    size_ -= most;
    while (is_fifo_ && taken.size() < most) {
      taken.push_back(line_.front().ray);
      taken_from(line_.front().link);
      line_.pop_front();
    }
    while (taken.size() < most) {
      while (classes_[deepest_].rays.empty()) --deepest_;
      auto& [rays, links] = classes_[deepest_];
      const auto last = static_cast<std::ptrdiff_t>(std::min(rays.size(), most - taken.size()));
      taken.insert(taken.end(), rays.end() - last, rays.end());
      rays.erase(rays.end() - last, rays.end());
      std::for_each(links.end() - last, links.end(), taken_from);
      links.erase(links.end() - last, links.end());
    }
    return taken;
  }

  bool is_empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  void clear() {
    classes_.clear();
    line_.clear();
    size_ = 0;
    deepest_ = 0;
  }

 private:
  /// Where each ray came from stands apart: rays are taken by the hundred, as a block.
  struct Class {
    std::vector<RayTask> rays;
    std::vector<std::uint32_t> links;
  };
  struct Held {
    RayTask ray;
    std::uint32_t link;
  };
  /// A shadow ray is a leaf of its tree: deeper than the rays of its generation.
  static std::size_t depth_class(const RayTask& ray) {
    return std::size_t{2} * ray.depth + (ray.kind == RayKind::kShadow ? 1 : 0);
  }

  std::vector<Class> classes_;
  /// All of them, where rays are taken as they came.
  std::deque<Held> line_;
  std::size_t size_ = 0;
  std::size_t deepest_ = 0;
  bool is_fifo_ = false;
};

}  // namespace graycube
