#include "csg/elliptic_torus.hpp"

#include "csg/quartic.hpp"
#include "csg/torus.hpp"

namespace graycube::csg {
namespace {

double ellipse(const Primitive& p, double outwards, double z) {
  return outwards * (p.v[0] * outwards + 2 * p.v[1] * z) + p.v[2] * z * z;
}
double ring_distance(const Vec3& l) { return std::sqrt(l.x * l.x + l.y * l.y) - 1; }
/// The same, measured from the opposite side of the ring.
double opposite_distance(const Vec3& l) { return -std::sqrt(l.x * l.x + l.y * l.y) - 1; }
bool reaches_across(const Primitive& p) { return p.v[3] > 1; }

}  // namespace

Spans elliptic_torus_spans(const Primitive& p, const Ray& ray) {
  const Vec3 o = p.to_local.point(ray.origin);
  const Vec3 d = p.to_local.vector(ray.direction);
  const double speed = length(d);
  const Vec3 u = {d.x / speed, d.y / speed, d.z / speed};
  const double nearest = -dot(o, u);
  const Vec3 q = (reaches_across(p)) ? off_the_axis(o + nearest * u, u) : o + nearest * u;
  const double radius2 = (1 + p.v[3]) * (1 + p.v[3]) + p.v[4] * p.v[4];
  const double reach2 = radius2 - dot(q, q);
  if (!(reach2 > 0)) return {};
  // A little beyond the bounding sphere, so that both ends lie outside.
  const double reach = std::sqrt(reach2) * (1 + 1e-6) + 1e-6;
  // With G = α ρ² + α − 2β z + γ z² − 1 and H = 2α − 2β z the solid is G ≤ ρ H, so G² ≤ ρ² H².
  const double alpha = p.v[0], beta = p.v[1], gamma = p.v[2];
  const Quadratic r2{q.x * q.x + q.y * q.y, 2 * (q.x * u.x + q.y * u.y), u.x * u.x + u.y * u.y};
  const Quadratic g{alpha * r2.a + alpha - 2 * beta * q.z + gamma * q.z * q.z - 1,
                    alpha * r2.b - 2 * beta * u.z + 2 * gamma * q.z * u.z,
                    alpha * r2.c + gamma * u.z * u.z};
  const double h0 = 2 * alpha - 2 * beta * q.z, h1 = -2 * beta * u.z;
  const ProductQuartic<2> line{{{{1, g, g}, {-1, product(h0, h1, h0, h1), r2}}}};
  const Spans spans = quartic_spans(
      line,
      QuarticRange::of_ray((nearest - reach) / speed, (nearest + reach) / speed, nearest, speed));
  if (!reaches_across(p)) return spans;
  return without_spindle(spans, ray,
                         [&](const Vec3& at) { return elliptic_torus_contains(p, at); });
}

bool elliptic_torus_contains(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  return ellipse(p, ring_distance(l), l.z) <= 1 ||
         (reaches_across(p) && ellipse(p, opposite_distance(l), l.z) <= 1);
}

Vec3 elliptic_torus_normal(const Primitive& p, const Vec3& q) {
  const Vec3 l = p.to_local.point(q);
  double outwards = ring_distance(l);
  const auto off = [&](double distance) { return std::fabs(ellipse(p, distance, l.z) - 1); };
  if (reaches_across(p) && off(opposite_distance(l)) < off(outwards)) {
    outwards = opposite_distance(l);
  }
  // Negative on the opposite side, where away from the axis is towards the ring.
  const double rho = 1 + outwards;
  const double away = p.v[0] * outwards + p.v[1] * l.z;
  const double up = p.v[1] * outwards + p.v[2] * l.z;
  if (is_on_axis(std::fabs(rho), ellipse(p, outwards, l.z) - 1, 2 * away)) {
    return normal_on_axis(p, up);
  }
  const double slope = away / rho;
  return normalized(p.to_local.transposed_vector({l.x * slope, l.y * slope, up}));
}

CellSide classify_elliptic_torus(const Primitive& p, const Aabb& cell) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  const Aabb l = mapped_bounds(p.to_local, near);
  const auto farther = [](double lo, double hi) { return std::fmax(std::fabs(lo), std::fabs(hi)); };
  const double x = distance_to_zero(l.lo.x, l.hi.x), y = distance_to_zero(l.lo.y, l.hi.y);
  const double far_x = farther(l.lo.x, l.hi.x), far_y = farther(l.lo.y, l.hi.y);
  const double least = std::sqrt(x * x + y * y) - 1;
  const double most = std::sqrt(far_x * far_x + far_y * far_y) - 1;
  if (least > p.v[3] || most < -p.v[3] || l.lo.z > p.v[4] || l.hi.z < -p.v[4])
    return CellSide::kOutside;
  if (near != cell) return CellSide::kCrosses;
  // The ellipse is convex: a rectangle is inside when its corners are.
  for (const double outwards : {least, most}) {
    for (const double z : {l.lo.z, l.hi.z}) {
      if (!(ellipse(p, outwards, z) < 1)) return CellSide::kCrosses;
    }
  }
  return CellSide::kInside;
}

}  // namespace graycube::csg
