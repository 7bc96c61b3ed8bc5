#include "csg/elliptic_cone.hpp"

#include "csg/box.hpp"
#include "csg/quartic.hpp"

namespace graycube::csg {
namespace {

/// How far beyond its bounds, as a share of their size, a solid is looked for: there its quartic is
/// positive.
constexpr double kBeyond = 1e-9;

struct Range {
  double lo, hi;
};
/// 1 − k z over an interval of z, not below 0.
Range radius_over(double k, double lo, double hi) {
  const double a = 1 - k * lo, b = 1 - k * hi;
  return {std::fmax(0, std::fmin(a, b)), std::fmax(0, std::fmax(a, b))};
}

/// Whether the line q + s u passes outside the widest ellipse of the cone for s in [enter, leave].
/// The ellipse is taken a little too large, so that a line that misses it has no roots.
bool misses_widest(const Vec3& q, const Vec3& u, double k, double enter, double leave) {
  constexpr double kWider = 1 + 1e-6;
  const double z0 = q.z + enter * u.z, z1 = q.z + leave * u.z;
  const double a = kWider * std::fmax(std::fabs(1 - z0), std::fabs(1 - z1));
  const double b = kWider * std::fmax(std::fabs(1 - k * z0), std::fabs(1 - k * z1));
  // |(b x, a y)|² along the line is a parabola: least at its middle, or where the piece ends.
  const double x = b * q.x, y = a * q.y, dx = b * u.x, dy = a * u.y;
  const double steepness = dx * dx + dy * dy;
  const double middle = steepness > 0 ? -(x * dx + y * dy) / steepness : 0;
  const double s = std::fmin(std::fmax(middle, enter), leave);
  const double nx = x + s * dx, ny = y + s * dy;
  return nx * nx + ny * ny > a * a * (b * b);
}

}  // namespace

Spans elliptic_cone_spans(const Primitive& p, const Ray& ray) {
  const Aabb box = p.bounds.grown(kBeyond * length(p.bounds.hi - p.bounds.lo));
  Interval i = box_interval(box.lo, box.hi, ray.origin, ray.direction);
  if (i.is_empty()) return {};
  clip_to_caps(i, p, ray);
  if (!(i.enter < i.leave)) return {};
  const double k = second_slope(p);
  const Vec3 o = p.to_local.point(ray.origin);
  const Vec3 d = p.to_local.vector(ray.direction);
  const double speed = length(d);
  const Vec3 u = {d.x / speed, d.y / speed, d.z / speed};
  // Recentred at the point nearest the frame's origin, and roots settled: so all solids that share
  // a surface between different caps are met at the same parameters.
  const double nearest = -dot(o, u);
  const Vec3 q = o + nearest * u;
  if (misses_widest(q, u, k, i.enter * speed - nearest, i.leave * speed - nearest)) return {};
  const Quadratic x = product(q.x, u.x, 1 - k * q.z, -k * u.z);
  const Quadratic y = product(q.y, u.y, 1 - q.z, -u.z);
  const Quadratic w = product(1 - q.z, -u.z, 1 - k * q.z, -k * u.z);
  return quartic_spans(SquaresQuartic{x, y, w},
                       QuarticRange::of_ray(i.enter, i.leave, nearest, speed), FindSettledRoot());
}

bool elliptic_cone_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  const double a = 1 - l.z, b = 1 - second_slope(p) * l.z;
  if (!(a >= 0 && b >= 0 && is_between_caps(p, q))) return false;
  const double x = l.x * b, y = l.y * a, w = a * b;
  return x * x + y * y <= w * w;
}

Vec3 elliptic_cone_normal(const Primitive& p, const Ray& ray, double t) {
  const Vec3 cap = cap_at(p, ray, t);
  if (cap != Vec3{}) return cap;
  const double k = second_slope(p);
  const Vec3 l = p.to_local.point(ray.at(t));
  const double a = 1 - l.z, b = 1 - k * l.z;
  const double x = l.x * b, y = l.y * a;
  if (is_at_tip(std::sqrt(x * x + y * y), a * b)) return tip_normal(p);
  return normalized(p.to_local.transposed_vector(
      {l.x * b * b, l.y * a * a, a * b * (b + k * a) - k * l.x * l.x * b - l.y * l.y * a}));
}

CellSide classify_elliptic_cone(const Primitive& p, const Aabb& cell) {
  if (misses_caps(p, cell)) return CellSide::kOutside;
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  const Aabb l = mapped_bounds(p.to_local, near);
  const Range a = radius_over(1, l.lo.z, l.hi.z);
  const Range b = radius_over(second_slope(p), l.lo.z, l.hi.z);
  const double x = distance_to_zero(l.lo.x, l.hi.x), y = distance_to_zero(l.lo.y, l.hi.y);
  // Multiplied out, since radii may be 0.
  if (x * x * b.hi * b.hi + y * y * a.hi * a.hi > a.hi * a.hi * b.hi * b.hi)
    return CellSide::kOutside;
  const double far_x = std::fmax(-l.lo.x, l.hi.x), far_y = std::fmax(-l.lo.y, l.hi.y);
  const bool is_within_sides =
      far_x * far_x * b.lo * b.lo + far_y * far_y * a.lo * a.lo < a.lo * a.lo * b.lo * b.lo;
  const Vec3 n = cap_normal(p);
  const bool is_within_caps =
      least_along(n, cell) > lower_cap(p) && greatest_along(n, cell) < upper_cap(p);
  return near == cell && is_within_sides && is_within_caps ? CellSide::kInside : CellSide::kCrosses;
}

}  // namespace graycube::csg
