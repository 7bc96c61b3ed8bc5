// The part of a model that a node's macro-regions need: what the frontal sends to a node.
#pragma once

#include <cstdint>
#include <vector>

#include "csg/model.hpp"
#include "regions/macro_grid.hpp"

namespace graycube {

/// What a node holds of a model, by object: all of it, a part of its tree, or nothing.
struct ModelContents {
  std::vector<bool> is_whole;
  struct Part {
    std::uint32_t object;
    std::vector<TreeNode> tree;
  };
  /// By object, increasing; none of them is whole.
  std::vector<Part> parts;

  /// A part gives way to the whole.
  void hold_whole(const std::vector<bool>& objects);
};

/// What the primary rays of a part of the picture need: a macro-region of a grid of its own.
struct PicturePart {
  MacroGrid grid;
  RegionIndex region;
};

/// What the macro-regions of a share need, and a part of the picture beside them: primitives that
/// certainly miss all of that, grown by the model's delta, become empty space, and the trees are
/// simplified.
ModelContents contents_of_share(const Model& model, const MacroGrid& grid, const RegionShare& share,
                                const PicturePart* beside = nullptr);

/// Only that is kept, renumbered; objects keep their order and id. Settings and materials stay.
Model extract(const Model& model, const ModelContents& contents);

/// Inside each region of the share the result looks like the whole.
inline Model restrict_to_share(const Model& model, const MacroGrid& grid,
                               const RegionShare& share) {
  return extract(model, contents_of_share(model, grid, share));
}

/// The share of a single region.
inline RegionShare only(RegionIndex region, const MacroGrid& grid) {
  return {grid.columns(), grid.rows(), region.column, region.row};
}

}  // namespace graycube
