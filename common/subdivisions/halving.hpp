// When cells that are cut in halves are cut no further.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

namespace graycube {

/// A cell with so few primitives is a leaf region: to go on from one cell to the next, a ray passes
/// about ten planes on its way down from the root, which costs it as much as a few primitives do.
inline constexpr std::size_t kFewPrimitives = 6;
/// The most times that a cell is halved along each axis, whatever the model.
inline constexpr int kMostHalvings = 12;

/// How often space is halved along each axis. Where n primitives are spread evenly, log₈ n halvings
/// give each a cell of its own; a few more follow their surfaces. So memory grows with n, and not
/// with the number of primitives that meet in a point.
inline int halvings_for(std::size_t primitives) {
  constexpr int kMore = 3;
  return std::min(kMostHalvings, static_cast<int>(std::bit_width(primitives) + 2) / 3 + kMore);
}

}  // namespace graycube
