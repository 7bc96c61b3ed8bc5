#include "csg/torus.hpp"

#include <optional>

#include "csg/quartic.hpp"

namespace graycube::csg {
namespace {

/// f(s) = (s² + 2Bs + A)² − 4 (e s² + 2hs + k) along the line q + s u, |u| = 1: negative inside.
/// Kept in this form, since the expanded quartic has lost the digits by the time it is evaluated.
struct TorusLine {
  double B, A, e, h, k;

  double f(double s) const {
    const double g = s * (s + 2 * B) + A;
    return g * g - 4 * (s * (e * s + 2 * h) + k);
  }
  double df(double s) const {
    const double g = s * (s + 2 * B) + A;
    return 4 * g * (s + B) - 8 * (e * s + h);
  }
  double ddf(double s) const {
    const double g = s * (s + 2 * B) + A;
    return 4 * g + 8 * (s + B) * (s + B) - 8 * e;
  }
  /// The zeros of f″, a quadratic: 12 s² + 24 B s + 4A + 8B² − 8e.
  void add_inflections(double lo, double hi, Knots<4>& knots) const {
    const double discriminant = B * B - (A + 2 * B * B - 2 * e) / 3;
    if (discriminant <= 0) return;
    const double root = std::sqrt(discriminant);
    for (const double s : {-B - root, -B + root}) {
      if (s > lo && s < hi) knots.add(s);
    }
  }
};

/// The part of the line q + s u that is in the bounding sphere and between the planes that the
/// torus touches; nothing when it passes outside or through the hole. All of these are taken a
/// little larger than the torus, so that both ends of the part lie outside of it.
std::optional<Interval> part_near_torus(const Vec3& q, const Vec3& u, double minor, double reach) {
  constexpr double kMargin = 1e-6;
  Interval part;
  part.clip(-reach * (1 + kMargin) - kMargin, reach * (1 + kMargin) + kMargin);
  const double height = minor * (1 + kMargin) + kMargin;
  if (u.z == 0) {
    if (std::fabs(q.z) > height) return std::nullopt;
  } else {
    const double a = (-height - q.z) / u.z;
    const double b = (height - q.z) / u.z;
    part.clip(std::fmin(a, b), std::fmax(a, b));
  }
  if (!(part.enter < part.leave)) return std::nullopt;
  const auto axis_distance2 = [&](double s) {
    const double x = q.x + s * u.x;
    const double y = q.y + s * u.y;
    return x * x + y * y;
  };
  // Convex in s: the largest distance from the axis is at an end.
  const double hole = 1 - height;
  const double farthest2 = std::fmax(axis_distance2(part.enter), axis_distance2(part.leave));
  if (hole > 0 && farthest2 < hole * hole) return std::nullopt;
  return part;
}

}  // namespace

Spans torus_spans(const Primitive& p, const Ray& ray) {
  const Vec3 o = p.to_local.point(ray.origin);
  const Vec3 d = p.to_local.vector(ray.direction);
  const double minor = torus_minor(p);
  const double speed = length(d);
  const Vec3 u = {d.x / speed, d.y / speed, d.z / speed};
  const double nearest = -dot(o, u);
  const Vec3 q = (minor > 1) ? off_the_axis(o + nearest * u, u) : o + nearest * u;
  const double reach2 = (1 + minor) * (1 + minor) - dot(q, q);
  if (!(reach2 > 0)) return {};
  const TorusLine line{dot(q, u), dot(q, q) + 1 - minor * minor, u.x * u.x + u.y * u.y,
                       q.x * u.x + q.y * u.y, q.x * q.x + q.y * q.y};
  const auto near = part_near_torus(q, u, minor, std::sqrt(reach2));
  if (!near) return {};
  const Spans spans =
      quartic_spans(line, QuarticRange::of_line(near->enter, near->leave, nearest, speed));
  if (!(minor > 1)) return spans;
  return without_spindle(spans, ray, [&](const Vec3& at) { return torus_contains(p, at); });
}

bool torus_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  const double from_ring = std::sqrt(l.x * l.x + l.y * l.y) - 1;
  return from_ring * from_ring + l.z * l.z <= torus_minor(p) * torus_minor(p);
}

Vec3 torus_normal(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  const double rho = std::sqrt(l.x * l.x + l.y * l.y);
  const double from_ring = rho - 1;
  const double off = from_ring * from_ring + l.z * l.z - torus_minor(p) * torus_minor(p);
  if (is_on_axis(rho, off, 2 * from_ring)) return normal_on_axis(p, l.z);
  const double shrink = 1 - 1 / rho;
  return normalized(p.to_local.transposed_vector({l.x * shrink, l.y * shrink, l.z}));
}

CellSide classify_torus(const Primitive& p, const Aabb& cell) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  const Aabb l = mapped_bounds(p.to_local, near);
  const auto farther = [](double lo, double hi) { return std::fmax(std::fabs(lo), std::fabs(hi)); };
  const double x = distance_to_zero(l.lo.x, l.hi.x);
  const double y = distance_to_zero(l.lo.y, l.hi.y);
  const double z = distance_to_zero(l.lo.z, l.hi.z);
  const double far_x = farther(l.lo.x, l.hi.x);
  const double far_y = farther(l.lo.y, l.hi.y);
  const double far_z = farther(l.lo.z, l.hi.z);
  const double least = std::sqrt(x * x + y * y) - 1;
  const double most = std::sqrt(far_x * far_x + far_y * far_y) - 1;
  const double ring = distance_to_zero(least, most);
  const double minor2 = torus_minor(p) * torus_minor(p);
  if (ring * ring + z * z > minor2) return CellSide::kOutside;
  const double farthest = std::fmax(std::fabs(least), std::fabs(most));
  if (near == cell && farthest * farthest + far_z * far_z < minor2) return CellSide::kInside;
  return CellSide::kCrosses;
}

}  // namespace graycube::csg
