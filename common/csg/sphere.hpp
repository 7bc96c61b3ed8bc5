// Spheres, in world coordinates; and ellipsoids, which `to_local` maps to the unit sphere.
#pragma once

#include "csg/roots.hpp"

namespace graycube::csg {

inline Slots sphere_slots(const Vec3& center, double radius) {
  return {center.x, center.y, center.z, radius, 0, 0};
}
inline Vec3 sphere_center(const Slots& v) { return {v[0], v[1], v[2]}; }
inline double sphere_radius(const Slots& v) { return v[3]; }
inline double squared_radius(const Slots& v) { return sphere_radius(v) * sphere_radius(v); }

/// Recentred at the point of the line nearest the centre: b² − 4ac of the textbook loses all digits
/// for a small sphere far away (Haines, Günther, Akenine-Möller 2019).
inline Interval sphere_interval(const Vec3& origin, const Vec3& direction, double radius2) {
  const double dd = dot(direction, direction);
  const double nearest = -dot(origin, direction) / dd;
  const Vec3 q = origin + nearest * direction;
  const double h2 = radius2 - dot(q, q);
  if (!(h2 >= 0)) return {kInf, -kInf};
  const double half = std::sqrt(h2 / dd);
  return {nearest - half, nearest + half};
}

inline Spans sphere_spans(const Primitive& p, const Ray& ray) {
  return spans_of(
      sphere_interval(ray.origin - sphere_center(p.v), ray.direction, squared_radius(p.v)));
}
inline bool sphere_contains(const Primitive& p, const Vec3& q) {
  const Vec3 d = q - sphere_center(p.v);
  return dot(d, d) <= squared_radius(p.v);
}
inline Vec3 sphere_normal(const Primitive& p, const Vec3& q) {
  return normalized(q - sphere_center(p.v));
}
inline CellSide classify_sphere(const Primitive& p, const Aabb& cell) {
  const Vec3 c = sphere_center(p.v);
  const double r2 = squared_radius(p.v);
  double nearest2 = 0;
  double farthest2 = 0;
  for (int a = 0; a < 3; ++a) {
    const double lo = cell.lo[a] - c[a];
    const double hi = cell.hi[a] - c[a];
    const double near = distance_to_zero(lo, hi);
    const double far = std::fmax(-lo, hi);
    nearest2 += near * near;
    farthest2 += far * far;
  }
  if (nearest2 > r2) return CellSide::kOutside;
  return farthest2 < r2 ? CellSide::kInside : CellSide::kCrosses;
}

/// Like the move_… of every kind: moves the surface outwards by `by` (inwards if negative); leaves
/// the bounds alone. False when nothing is left.
inline bool move_sphere(Primitive& p, double by) {
  p.v[3] += by;
  return sphere_radius(p.v) > 0;
}

inline Spans ellipsoid_spans(const Primitive& p, const Ray& ray) {
  return spans_of(
      sphere_interval(p.to_local.point(ray.origin), p.to_local.vector(ray.direction), 1.0));
}
inline bool ellipsoid_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  return dot(l, l) <= 1;
}
inline Vec3 ellipsoid_normal(const Primitive& p, const Vec3& q) {
  return normalized(p.to_local.transposed_vector(p.to_local.point(q)));
}
inline CellSide classify_ellipsoid(const Primitive& p, const Aabb& cell) {
  const auto misses = [](const Aabb& l) {
    const double x = distance_to_zero(l.lo.x, l.hi.x);
    const double y = distance_to_zero(l.lo.y, l.hi.y);
    const double z = distance_to_zero(l.lo.z, l.hi.z);
    return x * x + y * y + z * z > 1;
  };
  return classify_bounded(p, cell, misses, [&](const Vec3& q) { return ellipsoid_contains(p, q); });
}

inline bool move_ellipsoid(Primitive& p, double by) {
  const double radius = 1 + by * stretch(p.to_local, 3);
  if (!(radius > 0)) return false;
  divide_rows(p.to_local, 3, radius);
  return true;
}

}  // namespace graycube::csg
