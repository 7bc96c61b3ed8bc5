// Limits of the rays in the machine; only tests set others than these.
#pragma once

#include <cstdint>

#include "frontal/rendering/sliding_limits.hpp"
#include "proto/messages.hpp"

namespace graycube {

struct FlowLimits {
  /// Own tiles that a node may have open at a time in `macro`: open until the frontal holds all
  /// their light. All rays in the machine descend from them (design section 10).
  std::uint32_t window_tiles = 256;
  /// A node may have fewer tiles open when more than so many rays would descend from them, as far
  /// as the pre-render tells, but not fewer than the least.
  double window_rays = 300'000;
  std::uint32_t least_window_tiles = 8;
  /// Bytes of rays that may be under way on a link and in its receiver's inbox.
  std::uint64_t link_credit_bytes = std::uint64_t{2} << 20;
  std::uint32_t batch_bytes = std::uint32_t{256} << 10;
  /// Rays that a node's outboxes may hold before it traces only rays on class credit. All places
  /// for such rays behind a node's links are a quarter of it, or one for each class and link.
  std::uint64_t outbox_rays = kDefaultOutboxRays;
  SlidingLimits sliding{};
};

}  // namespace graycube
