// Rays that wait to be sent across a link, oldest first.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "trace/ray_task.hpp"

namespace graycube {

class Outbox {
 public:
  /// Adds rays, and counts the link that each is about to cross.
  void add(std::span<const RayTask> rays) {
    rays_.insert(rays_.end(), rays.begin(), rays.end());
    for (RayTask& ray : std::span(rays_).last(rays.size())) cross_link(ray);
  }
  std::size_t size() const { return rays_.size() - sent_; }
  bool is_empty() const { return size() == 0; }
  /// The `count` oldest rays; the span is valid until the next call that changes anything.
  std::span<const RayTask> oldest(std::size_t count) const { return {rays_.data() + sent_, count}; }
  /// Forgets the `count` oldest. What has been sent stays in front until it is half of all: an
  /// outbox may hold millions, and moving those at each batch would cost more than everything else.
  void drop_oldest(std::size_t count) {
    sent_ += count;
    if (2 * sent_ < rays_.size()) return;
    rays_.erase(rays_.begin(), rays_.begin() + static_cast<std::ptrdiff_t>(sent_));
    sent_ = 0;
  }
  void clear() {
    rays_.clear();
    sent_ = 0;
  }

 private:
  std::vector<RayTask> rays_;
  std::size_t sent_ = 0;
};

}  // namespace graycube
