// The regions of the screen that the report's subdivision makes, with what they hold in depth.
#pragma once

#include <vector>

#include "figures/leaf_space.hpp"

namespace graycube::figures {

/// A region of the screen: in pixels, perhaps beyond the picture or infinite.
struct ScreenRegion {
  /// Its root among the nodes of the BSP.
  std::uint32_t node = 0;
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  /// Leaf regions that it is cut into in depth, and the primitives that these hold together.
  std::uint32_t leaves = 0, primitives = 0;
};

/// Those of an `arnaldi` space, in the order of the tree.
std::vector<ScreenRegion> screen_regions_of(const LeafSpace& space);

}  // namespace graycube::figures
