// What the solvers of the single kinds share: slabs, quadratics, boxes seen in a primitive's own
// frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "csg/primitive.hpp"

namespace graycube::csg {

inline constexpr double kInf = std::numeric_limits<double>::infinity();

/// One closed interval of a line; empty when enter > leave.
struct Interval {
  double enter = -kInf;
  double leave = kInf;

  bool is_empty() const { return !(enter <= leave); }
  void clip(double from, double to) {
    if (from > enter) enter = from;
    if (to < leave) leave = to;
  }
  void make_empty() {
    enter = kInf;
    leave = -kInf;
  }
};

/// The interval as spans; −0 becomes +0.
inline Spans spans_of(const Interval& i) {
  Spans s;
  if (!i.is_empty()) s.add(i.enter + 0.0, i.leave + 0.0);
  return s;
}

/// Where the line o + t d crosses the plane at distance `offset` along the normal, given n·o and
/// 1/(n·d). Every plane of every kind of primitive and of the subdivision uses this one expression,
/// so that coincident faces have bitwise equal parameters.
inline double plane_parameter(double offset, double origin, double inverse) {
  return (offset - origin) * inverse;
}

/// Clips to lo ≤ o + t d ≤ hi. A line parallel to the slab stays whole when it touches it.
inline void clip_to_slab(Interval& i, double lo, double hi, double o, double d) {
  const double inverse = 1.0 / d;
  if (!std::isfinite(inverse)) {
    if (o < lo || o > hi) i.make_empty();
    return;
  }
  const double a = plane_parameter(lo, o, inverse);
  const double b = plane_parameter(hi, o, inverse);
  if (d > 0) {
    i.clip(a, b);
  } else {
    i.clip(b, a);
  }
}

/// Clips to o + t d ≤ hi.
inline void clip_to_half_space(Interval& i, double hi, double o, double d) {
  const double inverse = 1.0 / d;
  if (!std::isfinite(inverse)) {
    if (o > hi) i.make_empty();
    return;
  }
  const double t = plane_parameter(hi, o, inverse);
  if (d > 0) {
    i.clip(-kInf, t);
  } else {
    i.clip(t, kInf);
  }
}

/// Does a slab face have exactly this parameter? Used to find the face that a root came from.
inline bool is_on_plane(double offset, double o, double d, double t) {
  const double inverse = 1.0 / d;
  return std::isfinite(inverse) && plane_parameter(offset, o, inverse) == t;
}

/// Distance from zero to the interval [lo, hi].
inline double distance_to_zero(double lo, double hi) { return lo > 0 ? lo : hi < 0 ? -hi : 0.0; }

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
