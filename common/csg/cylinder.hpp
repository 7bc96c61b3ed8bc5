// Capped cylinders and cones under any affine map. The lateral surface is solved in the primitive's
// frame; the caps are planes of the world, so that a cap flush with another face has the same
// parameter. A cylinder's side is x² + y² = 1, a cone's x² + y² = (1 + k z)² where 1 + k z ≥ 0.
#pragma once

#include "csg/half_space.hpp"
#include "csg/roots.hpp"

namespace graycube::csg {

inline Vec3 cap_normal(const Primitive& p) { return {p.v[0], p.v[1], p.v[2]}; }
/// The caps' offsets along the normal.
inline double lower_cap(const Primitive& p) { return p.v[3]; }
inline double upper_cap(const Primitive& p) { return p.v[4]; }
/// Sets both caps; the normal must be a unit vector without −0.
inline void set_caps(Primitive& p, const Vec3& normal, double lower, double upper) {
  p.v[0] = normal.x;
  p.v[1] = normal.y;
  p.v[2] = normal.z;
  p.v[3] = lower;
  p.v[4] = upper;
}
inline bool move_caps(Primitive& p, double by) {
  p.v[3] -= by;
  p.v[4] += by;
  return lower_cap(p) < upper_cap(p);
}

inline void clip_to_caps(Interval& i, const Primitive& p, const Ray& ray) {
  const Vec3 n = cap_normal(p);
  clip_to_slab(i, lower_cap(p), upper_cap(p), dot(n, ray.origin), dot(n, ray.direction));
}

/// The outward normal of the cap that is crossed at parameter t; zero when t is on the lateral
/// surface.
inline Vec3 cap_at(const Primitive& p, const Ray& ray, double t) {
  const Vec3 n = cap_normal(p);
  const double o = dot(n, ray.origin);
  const double d = dot(n, ray.direction);
  if (is_on_plane(upper_cap(p), o, d, t)) return n;
  if (is_on_plane(lower_cap(p), o, d, t)) return -n;
  return {};
}

inline bool is_between_caps(const Primitive& p, const Vec3& q) {
  const double h = dot(cap_normal(p), q);
  return h >= lower_cap(p) && h <= upper_cap(p);
}

/// True when no point of the cell lies between the caps.
inline bool misses_caps(const Primitive& p, const Aabb& cell) {
  const Vec3 n = cap_normal(p);
  return least_along(n, cell) > upper_cap(p) || greatest_along(n, cell) < lower_cap(p);
}

/// The part of the line o + t d with x² + y² ≤ 1.
inline Interval tube_interval(const Vec3& o, const Vec3& d) {
  const double dd = d.x * d.x + d.y * d.y;
  const double nearest = -(o.x * d.x + o.y * d.y) / dd;
  if (!std::isfinite(nearest)) {  // parallel to the axis
    if (o.x * o.x + o.y * o.y > 1) return {kInf, -kInf};
    return {};
  }
  const double x = o.x + nearest * d.x;
  const double y = o.y + nearest * d.y;
  const double h2 = 1 - (x * x + y * y);
  if (!(h2 >= 0)) return {kInf, -kInf};
  const double half = std::sqrt(h2 / dd);
  return {nearest - half, nearest + half};
}

inline Spans cylinder_spans(const Primitive& p, const Ray& ray) {
  Interval i = tube_interval(p.to_local.point(ray.origin), p.to_local.vector(ray.direction));
  clip_to_caps(i, p, ray);
  return spans_of(i);
}
inline bool cylinder_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  return l.x * l.x + l.y * l.y <= 1 && is_between_caps(p, q);
}
inline Vec3 cylinder_normal(const Primitive& p, const Ray& ray, double t) {
  const Vec3 cap = cap_at(p, ray, t);
  if (cap != Vec3{}) return cap;
  const Vec3 l = p.to_local.point(ray.at(t));
  return normalized(p.to_local.transposed_vector({l.x, l.y, 0}));
}
inline CellSide classify_cylinder(const Primitive& p, const Aabb& cell) {
  if (misses_caps(p, cell)) return CellSide::kOutside;
  const auto misses = [](const Aabb& l) {
    const double x = distance_to_zero(l.lo.x, l.hi.x);
    const double y = distance_to_zero(l.lo.y, l.hi.y);
    return x * x + y * y > 1;
  };
  return classify_bounded(p, cell, misses, [&](const Vec3& q) { return cylinder_contains(p, q); });
}

inline bool move_cylinder(Primitive& p, double by) {
  const double radius = 1 + by * stretch(p.to_local, 2);
  if (!(radius > 0) || !move_caps(p, by)) return false;
  divide_rows(p.to_local, 2, radius);
  return true;
}
inline Aabb grown_cylinder_bounds(const Primitive& p, double by) {
  const double across = by * stretch(p.to_local, 2);
  return grown_bounds(p, {across, across, by * length(p.to_local.row(2))});
}

/// w(z) = 1 + k z: the cone's radius at local height z; k < 0. The larger end is at z = 0 and the
/// smaller at 1, unless the frame is another cone's with the same surface.
inline double cone_slope(const Primitive& p) { return p.v[5]; }
inline void set_cone_slope(Primitive& p, double k) { p.v[5] = k; }

/// The part of the line with x² + y² ≤ (1 + k z)² on the nappe with 1 + k z ≥ 0, as far as that is
/// one interval; the caps cut the other nappe off.
Interval cone_interval(double k, const Vec3& o, const Vec3& d);

inline Spans cone_spans(const Primitive& p, const Ray& ray) {
  Interval i =
      cone_interval(cone_slope(p), p.to_local.point(ray.origin), p.to_local.vector(ray.direction));
  if (i.is_empty()) return {};
  clip_to_caps(i, p, ray);
  return spans_of(i);
}
inline bool cone_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  const double w = 1 + cone_slope(p) * l.z;
  return w >= 0 && l.x * l.x + l.y * l.y <= w * w && is_between_caps(p, q);
}
/// Whether a point found on a cone is its tip, to within rounding: there its distance from the axis
/// has nothing to do with the radius of the cone at its height.
inline bool is_at_tip(double distance, double radius) {
  constexpr double kShare = 1.0 / 64;
  return !(radius > 0 && std::fabs(distance - radius) <= kShare * radius);
}
/// The normal of a tip or a ridge: between those of the sides around it.
inline Vec3 tip_normal(const Primitive& p) {
  return normalized(p.to_local.transposed_vector({0, 0, 1}));
}
inline Vec3 cone_normal(const Primitive& p, const Ray& ray, double t) {
  const Vec3 cap = cap_at(p, ray, t);
  if (cap != Vec3{}) return cap;
  const Vec3 l = p.to_local.point(ray.at(t));
  const double k = cone_slope(p);
  const double radius = 1 + k * l.z;
  if (is_at_tip(std::sqrt(l.x * l.x + l.y * l.y), radius)) return tip_normal(p);
  return normalized(p.to_local.transposed_vector({l.x, l.y, -k * radius}));
}
inline CellSide classify_cone(const Primitive& p, const Aabb& cell) {
  if (misses_caps(p, cell)) return CellSide::kOutside;
  const auto misses = [&](const Aabb& l) {
    const double x = distance_to_zero(l.lo.x, l.hi.x);
    const double y = distance_to_zero(l.lo.y, l.hi.y);
    const double widest = std::fmax(0, 1 + cone_slope(p) * l.lo.z);
    return x * x + y * y > widest * widest;
  };
  return classify_bounded(p, cell, misses, [&](const Vec3& q) { return cone_contains(p, q); });
}

bool move_cone(Primitive& p, double by);
Aabb grown_cone_bounds(const Primitive& p, double by);

}  // namespace graycube::csg
