// Boxes along the world's axes; and parallelepipeds, which `to_local` maps to such a box. Its rows
// are the unit normals of the faces, so that faces are planes of the world.
#pragma once

#include "csg/roots.hpp"

namespace graycube::csg {

inline Slots box_slots(const Vec3& lo, const Vec3& hi) {
  return {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
}
inline Vec3 box_lo(const Primitive& p) { return {p.v[0], p.v[1], p.v[2]}; }
inline Vec3 box_hi(const Primitive& p) { return {p.v[3], p.v[4], p.v[5]}; }
/// A coordinate of the lower (side 0) or the upper corner (side 1).
inline double box_side(const Slots& v, std::size_t side, std::size_t axis) {
  return v[3 * side + axis];
}
inline void set_box_side(Primitive& p, std::size_t side, std::size_t axis, double at) {
  p.v[3 * side + axis] = at;
}

inline Interval box_interval(const Vec3& lo, const Vec3& hi, const Vec3& o, const Vec3& d) {
  Interval i;
  for (int a = 0; a < 3; ++a) clip_to_slab(i, lo[a], hi[a], o[a], d[a]);
  return i;
}

/// The outward axis direction of the face whose parameter is t; the first axis wins at an edge.
inline Vec3 box_face(const Vec3& lo, const Vec3& hi, const Vec3& o, const Vec3& d, double t) {
  for (int a = 0; a < 3; ++a) {
    Vec3 n;
    n[a] = 1;
    if (is_on_plane(hi[a], o[a], d[a], t)) return n;
    if (is_on_plane(lo[a], o[a], d[a], t)) return -n;
  }
  return {};
}

inline Spans box_spans(const Primitive& p, const Ray& ray) {
  return spans_of(box_interval(box_lo(p), box_hi(p), ray.origin, ray.direction));
}
inline bool box_contains(const Primitive& p, const Vec3& q) {
  return Aabb{box_lo(p), box_hi(p)}.contains(q);
}
inline Vec3 box_normal(const Primitive& p, const Ray& ray, double t) {
  return box_face(box_lo(p), box_hi(p), ray.origin, ray.direction, t);
}
inline CellSide classify_box(const Primitive& p, const Aabb& cell) {
  const Vec3 lo = box_lo(p);
  const Vec3 hi = box_hi(p);
  bool inside = true;
  for (int a = 0; a < 3; ++a) {
    if (cell.hi[a] < lo[a] || cell.lo[a] > hi[a]) return CellSide::kOutside;
    inside = inside && cell.lo[a] > lo[a] && cell.hi[a] < hi[a];
  }
  return inside ? CellSide::kInside : CellSide::kCrosses;
}

/// Moves a box or a parallelepiped.
inline bool move_box(Primitive& p, double by) {
  for (std::size_t a = 0; a < 3; ++a) {
    p.v[a] -= by;
    p.v[a + 3] += by;
    if (!(p.v[a] < p.v[a + 3])) return false;
  }
  return true;
}

inline Spans parallelepiped_spans(const Primitive& p, const Ray& ray) {
  return spans_of(box_interval(box_lo(p), box_hi(p), p.to_local.point(ray.origin),
                               p.to_local.vector(ray.direction)));
}
inline bool parallelepiped_contains(const Primitive& p, const Vec3& q) {
  return Aabb{box_lo(p), box_hi(p)}.contains(p.to_local.point(q));
}
inline Vec3 parallelepiped_normal(const Primitive& p, const Ray& ray, double t) {
  return p.to_local.transposed_vector(box_face(box_lo(p), box_hi(p), p.to_local.point(ray.origin),
                                               p.to_local.vector(ray.direction), t));
}
inline CellSide classify_parallelepiped(const Primitive& p, const Aabb& cell) {
  const Vec3 lo = box_lo(p), hi = box_hi(p);
  const auto misses = [&](const Aabb& l) { return !l.overlaps({lo, hi}); };
  const auto holds = [&](const Vec3& q) {
    const Vec3 l = p.to_local.point(q);
    return l.x > lo.x && l.x < hi.x && l.y > lo.y && l.y < hi.y && l.z > lo.z && l.z < hi.z;
  };
  return classify_bounded(p, cell, misses, holds);
}

inline Aabb grown_parallelepiped_bounds(const Primitive& p, double by) {
  return grown_bounds(p, {by * length(p.to_local.row(0)), by * length(p.to_local.row(1)),
                          by * length(p.to_local.row(2))});
}

}  // namespace graycube::csg
