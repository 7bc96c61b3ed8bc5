// The part of a model that a node's macro-regions need: what the frontal sends to a node.
#pragma once

#include <cstdint>
#include <vector>

#include "csg/model.hpp"
#include "regions/macro_grid.hpp"

namespace graycube {

/// The part of a model that a node holds: of each object all, a part of its tree, or nothing.
struct ModelContents {
  std::vector<bool> is_whole;
  struct Part {
    std::uint32_t object;
    std::vector<TreeNode> tree;
  };
  /// Objects held in part, in increasing order; none of them is also whole.
  std::vector<Part> parts;

  /// Holds the given objects whole, instead of their parts.
  void hold_whole(const std::vector<bool>& objects);
};

/// A part of the picture, as a macro-region of a grid made for it: its primary rays stay in that.
struct PicturePart {
  MacroGrid grid;
  RegionIndex region;
};

/// The part of a model that a share's macro-regions, and the picture part `beside` if given, need:
/// primitives that certainly miss all these, grown by the model's delta, become empty space, and
/// the trees are simplified.
ModelContents contents_of_share(const Model& model, const MacroGrid& grid, const RegionShare& share,
                                const PicturePart* beside = nullptr);

/// The model with only `contents`, renumbered; objects keep order and id; settings, materials stay.
Model extract(const Model& model, const ModelContents& contents);

/// The model that looks like the whole one inside each region of the share.
inline Model restrict_to_share(const Model& model, const MacroGrid& grid,
                               const RegionShare& share) {
  return extract(model, contents_of_share(model, grid, share));
}

/// The share of a single region.
inline RegionShare only(RegionIndex region, const MacroGrid& grid) {
  return {grid.columns(), grid.rows(), region.column, region.row, grid.slabs(), region.slab};
}

}  // namespace graycube
