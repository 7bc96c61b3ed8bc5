// Functions that several kinds share: boxes seen in a primitive's own frame, and frames that grow.
#pragma once

#include <algorithm>
#include <cmath>

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

/// Classifies a cell against a bounded primitive, by misses(local bounds of the part of the cell
/// near the primitive) and, for a convex primitive, holds(world point).
template <typename Misses, typename Holds>
CellSide classify_bounded(const Primitive& p, const Aabb& cell, Misses&& misses, Holds&& holds) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  if (misses(mapped_bounds(p.to_local, near))) return CellSide::kOutside;
  if (near == cell && all_corners(cell, holds)) return CellSide::kInside;
  return CellSide::kCrosses;
}

/// The most by which a local point can move in the space of the first `rows` local axes when the
/// world point moves by 1: no less than the norm of these rows (by Gershgorin's circles).
inline double stretch(const Affine& to_local, int rows) {
  double most = 0;
  for (int i = 0; i < rows; ++i) {
    double sum = 0;
    for (int j = 0; j < rows; ++j) sum += std::fabs(dot(to_local.row(i), to_local.row(j)));
    most = std::max(most, sum);
  }
  return std::sqrt(most);
}

/// Makes the first rows of a map into the frame smaller: the solid grows along these axes.
inline void divide_rows(Affine& map, int rows, double by) {
  for (int i = 0; i < rows; ++i) {
    for (double& x : map.m[static_cast<std::size_t>(i)]) x /= by;
  }
}

/// The bounds of a solid that grows by `local` along each of its own axes.
inline Aabb grown_bounds(const Primitive& p, const Vec3& local) {
  const auto to_world = p.to_local.inverse();
  if (!to_world) return Aabb::everything();
  Vec3 by;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = to_world->row(i);
    by[i] = std::fabs(r.x) * local.x + std::fabs(r.y) * local.y + std::fabs(r.z) * local.z;
  }
  return {p.bounds.lo - by, p.bounds.hi + by};
}
/// Bounds of a solid that grows by `by` (scene units) in all directions.
inline Aabb bounds_grown_around(const Primitive& p, double by) {
  const double all = by * stretch(p.to_local, 3);
  return grown_bounds(p, {all, all, all});
}

}  // namespace graycube::csg
