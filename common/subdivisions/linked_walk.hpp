// Walking a ray through the leaf regions of a BSP by neighbour links. An order (PlaneOrder,
// FrustumOrder) tells, for one ray, on which side of the BSP's planes it is at a parameter.
#pragma once

#include "crossings/bsp.hpp"
#include "crossings/mailbox.hpp"
#include "subdivisions/plane_order.hpp"

namespace graycube {

/// The leaf region below `node` that the ray is in at parameter t.
template <typename Order>
const BspLeaf& leaf_at(const Bsp& bsp, std::uint32_t node, const Order& order, double t,
                       WalkCounts& counts) {
  for (;;) {
    const BspNode& n = bsp.nodes()[node];
    if (n.axis == BspNode::kLeafAxis) return bsp.leaves()[n.child];
    ++counts.nodes_descended;
    node = n.child + (order.is_above(n.axis, n.split, t) ? 1u : 0u);
  }
}

/// Calls `visit(leaf, t0, t1)` for the leaf regions along the ray that hold something, from the one
/// that it is in at t0 on. They cover [t0, t1) in half-open pieces, until `visit` returns false or
/// the ray has left; returns false in the first case.
template <typename Order, typename Visit>
bool walk_links(const Bsp& bsp, const Order& order, const BspLeaf& first, double t0, double t1,
                WalkCounts& counts, Visit&& visit) {
  const BspLeaf* leaf = &first;
  while (t0 < t1) {
    ++counts.cells_visited;
    const CellExit exit = exit_of(leaf->cell, order);
    double end = exit.t > t0 ? exit.t : t0;
    if (end > t1) end = t1;
    if (leaf->program_count > 0 && !visit(*leaf, t0, end)) return false;
    if (exit.face < 0 || !(end < t1)) break;
    const std::uint32_t node = leaf->neighbour[static_cast<std::size_t>(exit.face)];
    if (node == kNoNeighbour) break;
    t0 = end;
    leaf = &leaf_at(bsp, node, order, t0, counts);
  }
  return true;
}

}  // namespace graycube
