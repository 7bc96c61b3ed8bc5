// Pipes are tubes along a bent line; particles are straight ones with balls at their ends.
#include <cmath>
#include <utility>

#include "formats/brlcad/solid_nodes.hpp"

namespace graycube::brlcad {

BrlcadNode particle(const Values& p, double grow) {
  const Vec3 v = p.point(0), h = p.vector(1);
  const double rv = p.number(6) * p.scale() + grow, rh = p.number(7) * p.scale() + grow;
  if (!(p.number(6) >= 0 && p.number(7) >= 0 && std::fmax(rv, rh) > 0))
    return problem("a radius is below 0, or both are 0");
  const double l = length(h);
  if (!(std::fabs(rv - rh) < l * (1 - kTiny))) {
    return built(node_of(rv >= rh ? SphereShape{v, rv} : SphereShape{v + h, rh}));
  }
  // The part between the balls is the cone that touches both.
  const double sine = (rv - rh) / l;
  const double cosine = std::sqrt(1 - sine * sine);
  const Vec3 along = (1 / l) * h;
  std::vector<CsgNode> parts;
  if (rv > 0) parts.push_back(node_of(SphereShape{v, rv}));
  if (rh > 0) parts.push_back(node_of(SphereShape{v + h, rh}));
  parts.push_back(
      round_cone(v + rv * sine * along, rv * cosine, v + h + rh * sine * along, rh * cosine));
  return built(operation(Operation::kUnion, std::move(parts)));
}

namespace {

struct PipePoint {
  Vec3 at;
  double inner, outer, bend;
};

/// The solid that a pipe's outside (or inside) sweeps: cones, and sectors of tori around the bends.
/// A bend tighter than its tube is thick is a sector of a torus that closes its hole, as by rt.
void sweep(const std::vector<PipePoint>& points, bool is_inner, double grow,
           std::vector<CsgNode>& out) {
  const auto radius = [&](const PipePoint& p) {
    return 0.5 * (is_inner ? p.inner : p.outer) + grow;
  };
  const auto has_any = [&](const PipePoint& p) { return (is_inner ? p.inner : p.outer) > 0; };
  Vec3 from = points.front().at;
  const auto straight = [&](const Vec3& to, const PipePoint& a, const PipePoint& b) {
    const double l = length(to - from);
    if (!(l > kBrlcadSkin) || (!has_any(a) && !has_any(b))) return;
    const Vec3 e = (grow / l) * (to - from);
    out.push_back(round_cone(from - e, radius(a), to + e, radius(b)));
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PipePoint& here = points[i];
    if (i + 1 == points.size()) {
      straight(here.at, points[i - 1], here);
      break;
    }
    const Vec3 back = normalized(points[i - 1].at - here.at);
    const Vec3 ahead = normalized(points[i + 1].at - here.at);
    const Vec3 normal = cross(back, ahead);
    // Without a bend the straight parts meet at the point, and nothing rounds the corner.
    if (!(length(normal) > 1e-7 && here.bend > kBrlcadSkin)) {
      straight(here.at, points[i - 1], here);
      from = here.at;
      continue;
    }
    // tan of half the bend's angle: the angle between −back and ahead.
    const double cosine = dot(back, ahead);
    const double reach = here.bend * std::sqrt((1 + cosine) / (1 - cosine));
    const Vec3 start = here.at + reach * back;
    straight(start, points[i - 1], here);
    from = here.at + reach * ahead;
    if (!has_any(here)) continue;
    const Vec3 inwards = normalized(back + ahead);
    const Vec3 center = here.at + std::sqrt(reach * reach + here.bend * here.bend) * inwards;
    std::vector<CsgNode> sector;
    sector.push_back(round_torus(center, normal, here.bend, radius(here) - grow, grow));
    sector.push_back(node_of(HalfSpaceShape{back, dot(back, center) + grow}));
    sector.push_back(node_of(HalfSpaceShape{ahead, dot(ahead, center) + grow}));
    out.push_back(operation(Operation::kIntersection, std::move(sector)));
  }
}

}  // namespace

BrlcadNode pipe(const Values& p, double grow) {
  std::vector<PipePoint> points;
  const double scale = p.scale();
  bool is_hollow = false;
  for (std::size_t i = 0; i + 5 < p.v.size(); i += 6) {
    const double* v = p.v.data() + i;
    points.push_back({p.map.point({v[0], v[1], v[2]}), v[3] * scale, v[4] * scale, v[5] * scale});
    is_hollow = is_hollow || v[3] > 0;
    if (!(v[4] > 0) || v[3] < 0 || v[3] > v[4] || v[5] < 0)
      return problem("a diameter is out of range");
  }
  if (points.size() < 2) return problem("it has fewer than two points");
  std::vector<CsgNode> outside, inside;
  sweep(points, false, grow, outside);
  // The bore that is subtracted ends flush with the tube: it is grown when the tube is not.
  if (is_hollow) sweep(points, true, kBrlcadSkin - grow, inside);
  if (outside.empty()) return problem("it has no length");
  std::vector<CsgNode> parts;
  parts.push_back(operation(Operation::kUnion, std::move(outside)));
  for (CsgNode& bore : inside) parts.push_back(std::move(bore));
  return built(operation(Operation::kDifference, std::move(parts)));
}

}  // namespace graycube::brlcad
