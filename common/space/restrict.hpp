// The part of a model that one macro-region needs: what the frontal sends to a node.
#pragma once

#include "csg/model.hpp"
#include "space/macro_grid.hpp"

namespace graycube {

/// Primitives that certainly miss the region grown by the model's delta become empty space, the trees are
/// simplified, and only what is left is kept, renumbered; objects keep their id. Settings and materials stay.
Model restrict_to_region(const Model& model, const MacroGrid& grid, RegionIndex region);

}  // namespace graycube
