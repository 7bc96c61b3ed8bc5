// Rays that came on the credit of their classes, and what descends from them on this node: a full
// node traces nothing else (docs/design/flow.md). A ray's class is the number of links crossed,
// RayTask::hops.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "trace/ray_task.hpp"

namespace graycube {

class ClassStore {
 public:
  struct Held {
    RayTask ray;
    /// The bit across which it came: its class's credit goes back there when it is taken. Nothing
    /// if it was created here.
    std::optional<std::uint32_t> link;
  };

  /// Puts a ray below its class's: what descends from one ray is done before the next begins.
  void add_received(const RayTask& ray, std::uint32_t link) {
    rays_.emplace_hint(rays_.lower_bound(ray.hops), ray.hops, Held{ray, link});
  }
  void add_own(std::span<const RayTask> rays) {
    for (const RayTask& ray : rays)
      rays_.emplace_hint(rays_.upper_bound(ray.hops), ray.hops, Held{ray, {}});
  }
  bool is_empty() const { return rays_.empty(); }
  std::size_t size() const { return rays_.size(); }
  void clear() { rays_.clear(); }

  /// The highest class with rays for which `may_take(class)`.
  template <typename MayTake>
  std::optional<std::uint16_t> highest(MayTake&& may_take) const {
    for (auto last = rays_.end(); last != rays_.begin();
         last = rays_.lower_bound(std::prev(last)->first)) {
      if (may_take(std::prev(last)->first)) return std::prev(last)->first;
    }
    return std::nullopt;
  }
  /// A ray of that class, of which there must be one.
  Held take(std::uint16_t of_class) {
    const auto last = std::prev(rays_.upper_bound(of_class));
    const Held taken = last->second;
    rays_.erase(last);
    return taken;
  }

 private:
  std::multimap<std::uint16_t, Held> rays_;
};

}  // namespace graycube
