#include "csg/quadric.hpp"

#include "csg/cylinder.hpp"

namespace graycube::csg {
namespace {

/// The solution of a s² + 2 b s + c ≤ 0: the stretch between two roots, or all but that.
struct Roots {
  double lower = 0, upper = 0;
  enum class Where : std::uint8_t { kNowhere, kEverywhere, kBetween, kOutside, kBelow, kAbove };
  Where where = Where::kNowhere;
};

Roots negative_part(double a, double b, double c) {
  using Where = Roots::Where;
  Roots r;
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) {
    r.where = a > 0 ? Where::kNowhere : Where::kEverywhere;
    return r;
  }
  // Without cancellation; a may be anything down to zero.
  const double w = b >= 0 ? -(b + std::sqrt(discriminant)) : -b + std::sqrt(discriminant);
  if (w == 0) {  // b = 0 and a c = 0
    if (a > 0) return {0, 0, Where::kBetween};
    r.where = c <= 0 ? Where::kEverywhere : Where::kNowhere;
    return r;
  }
  const double r0 = w / a, r1 = c / w;
  if (!std::isfinite(r0)) return {r1, r1, b > 0 ? Where::kBelow : Where::kAbove};
  r.lower = std::fmin(r0, r1);
  r.upper = std::fmax(r0, r1);
  r.where = a > 0 ? Where::kBetween : Where::kOutside;
  return r;
}

/// The least and the greatest of k v² + m v over an interval.
struct Range {
  double lo, hi;
};
Range quadratic_range(double k, double m, double lo, double hi) {
  const auto at = [&](double v) { return (k * v + m) * v; };
  Range r{std::fmin(at(lo), at(hi)), std::fmax(at(lo), at(hi))};
  const double turn = k != 0 ? -m / (2 * k) : kInf;
  if (turn > lo && turn < hi) r = {std::fmin(r.lo, at(turn)), std::fmax(r.hi, at(turn))};
  return r;
}

}  // namespace

Spans quadric_spans(const Primitive& p, std::span<const Plane> faces, const Ray& ray) {
  Interval whole;
  for (const Plane& f : faces) {
    clip_to_half_space(whole, f.offset, dot(f.normal, ray.origin), dot(f.normal, ray.direction));
    if (whole.is_empty()) return {};
  }
  const Vec3 o = p.to_local.point(ray.origin);
  const Vec3 d = p.to_local.vector(ray.direction);
  if (is_tube(p)) {
    const Interval side = tube_interval(o, d);
    whole.clip(side.enter, side.leave);
    return spans_of(whole);
  }
  const double nearest = -dot(o, d) / dot(d, d);
  const Vec3 q = o + nearest * d;
  const double a = d.x * d.x + p.v[0] * d.y * d.y + p.v[1] * d.z * d.z;
  const double b = q.x * d.x + p.v[0] * q.y * d.y + (p.v[1] * q.z + 0.5 * p.v[2]) * d.z;
  const Roots r = negative_part(a, b, quadric_value(p, q));
  const double lower = r.lower + nearest, upper = r.upper + nearest;
  Spans spans;
  const auto add = [&](double enter, double leave) {
    Interval i = whole;
    i.clip(enter, leave);
    if (!i.is_empty()) spans.add(i.enter + 0.0, i.leave + 0.0);
  };
  switch (r.where) {
    case Roots::Where::kNowhere: break;
    case Roots::Where::kEverywhere: add(-kInf, kInf); break;
    case Roots::Where::kBetween: add(lower, upper); break;
    case Roots::Where::kBelow: add(-kInf, lower); break;
    case Roots::Where::kAbove: add(upper, kInf); break;
    case Roots::Where::kOutside:
      add(-kInf, lower);
      add(upper, kInf);
      break;
  }
  return spans;
}

bool quadric_contains(const Primitive& p, std::span<const Plane> faces, const Vec3& q) {
  return quadric_value(p, p.to_local.point(q)) <= 0 && polyhedron_contains(faces, q);
}

Vec3 quadric_normal(const Primitive& p, std::span<const Plane> faces, const Ray& ray, double t) {
  const Vec3 flat = polyhedron_normal(faces, ray, t);
  if (flat != Vec3{}) return flat;
  const Vec3 l = p.to_local.point(ray.at(t));
  const Vec3 n =
      normalized(p.to_local.transposed_vector({l.x, p.v[0] * l.y, p.v[1] * l.z + 0.5 * p.v[2]}));
  // Where two nappes meet no direction is outwards; the tip faces whoever touches it.
  return n != Vec3{} ? n : -normalized(ray.direction);
}

CellSide classify_quadric(const Primitive& p, std::span<const Plane> faces, const Aabb& cell) {
  const CellSide flat = classify_polyhedron(p, faces, cell);
  if (flat == CellSide::kOutside) return flat;
  const Aabb l = mapped_bounds(p.to_local, intersection_of(cell, p.bounds));
  const Range x = quadratic_range(1, 0, l.lo.x, l.hi.x);
  const Range y = quadratic_range(p.v[0], 0, l.lo.y, l.hi.y);
  const Range z = quadratic_range(p.v[1], p.v[2], l.lo.z, l.hi.z);
  if (x.lo + y.lo + z.lo + p.v[3] > 0) return CellSide::kOutside;
  const bool is_within = x.hi + y.hi + z.hi + p.v[3] < 0;
  return flat == CellSide::kInside && is_within ? CellSide::kInside : CellSide::kCrosses;
}

}  // namespace graycube::csg
