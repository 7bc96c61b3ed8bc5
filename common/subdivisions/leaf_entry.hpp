// The leaf region in which a ray begins, found without going down from the root (report, 3.3.3 and
// figure 8): from the BSP's leftmost or rightmost leaf region, whichever is on the ray's side of
// the root's plane, by links.
#pragma once

#include "subdivisions/linked_walk.hpp"

namespace graycube {

/// The two outermost leaf regions of a BSP: always the lower, and always the upper child.
class OutermostLeaves {
 public:
  explicit OutermostLeaves(const Bsp& bsp) : leftmost_(of(bsp, 0)), rightmost_(of(bsp, 1)) {}

  /// The leaf region that the ray is in at t, as leaf_at finds it from the root. Through any face
  /// on whose far side the ray is, a link leads to the subtree that touches the whole face, and
  /// only below that subtree's root planes are compared again. Along the face's axis this comes
  /// nearer to the ray's place. On both others the subtree is as wide as the face at least, and
  /// going down in it chooses the part nearest to the ray's place, so that no axis gets worse:
  /// there are finitely many leaf regions, and the ray's is reached. Where planes are so close that
  /// their parameters come out in the wrong order, this isn't so; then, after as many links as
  /// there are leaf regions, the root is asked.
  template <typename Order>
  const BspLeaf& enter(const Bsp& bsp, const Order& order, double t, WalkCounts& counts) const {
    return enter(bsp, order, t, counts, [](const BspLeaf&) {});
  }
  /// The same; calls `pass(leaf)` for each leaf region on the way, the outermost one first and the
  /// ray's own last.
  template <typename Order, typename Pass>
  const BspLeaf& enter(const Bsp& bsp, const Order& order, double t, WalkCounts& counts,
                       Pass&& pass) const {
    const BspNode& root = bsp.nodes()[0];
    if (root.axis == BspNode::kLeafAxis) {
      pass(bsp.leaves()[root.child]);
      return bsp.leaves()[root.child];
    }
    const BspLeaf* leaf =
        &bsp.leaves()[order.is_above(root.axis, root.split, t) ? rightmost_ : leftmost_];
    for (std::size_t links = 0; links < bsp.leaves().size(); ++links) {
      pass(*leaf);
      const std::uint32_t next = beyond(*leaf, order, t);
      if (next == kNoNeighbour) return *leaf;
      ++counts.entry_links;
      leaf = &leaf_at(bsp, next, order, t, counts);
    }
    leaf = &leaf_at(bsp, 0, order, t, counts);
    pass(*leaf);
    return *leaf;
  }

 private:
  static std::uint32_t of(const Bsp& bsp, std::uint32_t side) {
    std::uint32_t node = 0;
    while (bsp.nodes()[node].axis != BspNode::kLeafAxis) node = bsp.nodes()[node].child + side;
    return bsp.nodes()[node].child;
  }
  /// The link through the first face on whose far side the ray is at t.
  template <typename Order>
  static std::uint32_t beyond(const BspLeaf& leaf, const Order& order, double t) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto face = static_cast<std::size_t>(axis) * 2;
      if (leaf.neighbour[face] != kNoNeighbour && !order.is_above(axis, leaf.cell.lo[axis], t)) {
        return leaf.neighbour[face];
      }
      if (leaf.neighbour[face + 1] != kNoNeighbour && order.is_above(axis, leaf.cell.hi[axis], t)) {
        return leaf.neighbour[face + 1];
      }
    }
    return kNoNeighbour;
  }

  std::uint32_t leftmost_, rightmost_;
};

}  // namespace graycube
