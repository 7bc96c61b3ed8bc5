// Limits of sliding boundaries; only tests set others than these.
#pragma once

#include <cstdint>

#include "regions/sliding_cuts.hpp"

namespace graycube {

struct SlidingLimits {
  SlideRules rules{};
  /// This part of the picture's tiles must have become whole since boundaries were last looked at.
  double part_between = 1.0 / 64;
  /// What is handed out stays under the boundaries of that moment. So a node gets few tiles ahead
  /// of those that it has begun: this part of its tiles that are left, or so many for each
  /// evaluator thread, if that is more.
  std::uint32_t least_ahead = 4;
  double most_ahead = 1.0 / 16;
};

}  // namespace graycube
