// What the solvers of the single kinds share: boxes seen in a primitive's own frame.
#pragma once

#include "csg/primitive.hpp"
#include "geometry/interval.hpp"

namespace graycube::csg {

/// The bounds of a finite box seen through an affine map.
inline Aabb mapped_bounds(const Affine& map, const Aabb& box) {
  Aabb r = Aabb::nothing();
  for (int i = 0; i < 8; ++i) r.include(map.point(box.corner(i)));
  return r;
}

/// True when every corner of a finite box satisfies the predicate.
template <typename Predicate>
bool all_corners(const Aabb& box, Predicate&& is_inside) {
  for (int i = 0; i < 8; ++i) {
    if (!is_inside(box.corner(i))) return false;
  }
  return true;
}

/// Where a cell lies relative to a bounded primitive whose own frame gives `misses(local bounds of
/// the part of the cell near the primitive)` and, for a convex primitive, `holds(world point)`.
template <typename Misses, typename Holds>
CellSide classify_bounded(const Primitive& p, const Aabb& cell, Misses&& misses, Holds&& holds) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  if (misses(mapped_bounds(p.to_local, near))) return CellSide::kOutside;
  if (near == cell && all_corners(cell, holds)) return CellSide::kInside;
  return CellSide::kCrosses;
}

}  // namespace graycube::csg
