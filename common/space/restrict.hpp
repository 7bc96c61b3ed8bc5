// The part of a model that a node's macro-regions need: what the frontal sends to a node.
#pragma once

#include "csg/model.hpp"
#include "space/macro_grid.hpp"

namespace graycube {

/// Primitives that certainly miss all regions of the share, grown by the model's delta, become empty space,
/// the trees are simplified, and only what is left is kept, renumbered; objects keep their id. Settings and
/// materials stay. Inside each region of the share the result looks like the whole.
Model restrict_to_share(const Model& model, const MacroGrid& grid, const RegionShare& share);

/// The share of a single region.
inline RegionShare only(RegionIndex region, const MacroGrid& grid) {
  return {grid.columns(), grid.rows(), region.column, region.row};
}

}  // namespace graycube
