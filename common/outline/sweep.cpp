#include "outline/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/interval.hpp"
#include "outline/crossings.hpp"
#include "outline/cuts.hpp"

namespace graycube::csg {
namespace {

/// A line seen along z, with the unit direction e in the plane; a line along z is seen as one
/// along x, all of which it passes at t = ±∞.
class FlatLine {
 public:
  FlatLine(const Vec3& origin, const Vec3& direction) {
    const double largest = std::max(std::fabs(direction.x), std::fabs(direction.y));
    ex_ = 1;
    ey_ = 0;
    if (largest > 0) {
      // Scaled, so that squares of small numbers don't vanish.
      const double x = direction.x / largest, y = direction.y / largest;
      const double l = std::sqrt(x * x + y * y);
      ex_ = x / l;
      ey_ = y / l;
      speed_ = largest * l;
    }
    along_ = ex_ * origin.x + ey_ * origin.y;
    offset_ = ex_ * origin.y - ey_ * origin.x;
  }

  /// The distance of a point from the line: positive to the left of it.
  double distance(const OutlinePoint& p) const { return (ex_ * p.y - ey_ * p.x) - offset_; }

  /// False only if all points of the box are on one side, by the very expression by which points
  /// are judged.
  bool may_cross(const OutlineBox& box) const {
    const double left_x = ey_ > 0 ? box.lo.x : box.hi.x, right_x = ey_ > 0 ? box.hi.x : box.lo.x;
    const double left_y = ex_ > 0 ? box.hi.y : box.lo.y, right_y = ex_ > 0 ? box.lo.y : box.hi.y;
    return !(distance({left_x, left_y}) < 0) && distance({right_x, right_y}) < 0;
  }

  /// By how much distances of points whose coordinates are up to 1 may be off.
  double error() const { return 0x1p-50 * (2 + std::fabs(offset_)); }

  double parameter(const OutlinePoint& p) const {
    const double way = (ex_ * p.x + ey_ * p.y) - along_;
    if (speed_ > 0) return way / speed_ + 0.0;
    return way < 0 ? -kInf : kInf;
  }

 private:
  double ex_, ey_, along_, offset_, speed_ = 0;
};

/// The distance of a part of a piece from the line.
struct SweepArc {
  Cubic distance;
  /// By how much the distances may be off.
  double error;
  /// The piece's parameters of the ends.
  double from, to;

  int changes(bool begins_negative, bool ends_negative) const {
    return sign_changes(distance.b, error, begins_negative, ends_negative);
  }
  std::pair<SweepArc, SweepArc> halves() const {
    const auto [first, second] = distance.split(0.5);
    const double middle = 0.5 * (from + to);
    return {{first, error, from, middle}, {second, error, middle, to}};
  }
  bool is_negative_at_end() const { return distance.b[3] < 0; }
  double value(double v) const { return distance.at(v); }
  double slope(double v) const { return distance.slope(v); }
};

void find_cuts(const PlacedOutline& p, const Ray& ray, OutlineCuts& cuts) {
  const FlatLine line(p.to_local.point(ray.origin), p.to_local.vector(ray.direction));
  const auto meets = [&](const OutlineBox& box) { return line.may_cross(box); };
  p.outline.each_piece(meets, [&](const OutlinePiece& piece) {
    SweepArc arc{{}, line.error(), 0, 1};
    for (std::size_t i = 0; i < 4; ++i)
      arc.distance.b[i] = line.distance({piece.x.b[i], piece.y.b[i]});
    const auto visit = [&](const SweepArc& part, double v) {
      const double at = part.from + v * (part.to - part.from);
      cuts.add({line.parameter(piece.at(at)), &piece, at});
    };
    each_sign_change(arc, arc.distance.b[0] < 0, arc.distance.b[3] < 0, visit);
  });
  cuts.settle();
}

Interval between_caps(const PlacedOutline& p, const Ray& ray) {
  Interval i;
  clip_to_slab(i, p.lower_cap, p.upper_cap, dot(p.cap_normal, ray.origin),
               dot(p.cap_normal, ray.direction));
  return i;
}

/// The outward normal of the end that is crossed at t; zero if none is.
Vec3 end_at(const PlacedOutline& p, const Ray& ray, double t) {
  const double o = dot(p.cap_normal, ray.origin), d = dot(p.cap_normal, ray.direction);
  if (is_on_plane(p.upper_cap, o, d, t)) return p.cap_normal;
  if (is_on_plane(p.lower_cap, o, d, t)) return -p.cap_normal;
  return {};
}

}  // namespace

Spans sweep_spans(const PlacedOutline& p, const Ray& ray) {
  Spans spans;
  const Interval whole = between_caps(p, ray);
  if (whole.is_empty()) return spans;
  OutlineCuts cuts;
  find_cuts(p, ray, cuts);
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
    Interval part = whole;
    part.clip(cuts[i].t, cuts[i + 1].t);
    if (!part.is_empty()) spans.add(part.enter + 0.0, part.leave + 0.0);
  }
  return spans;
}

bool sweep_contains(const PlacedOutline& p, const Vec3& point) {
  const double height = dot(p.cap_normal, point);
  if (!(height >= p.lower_cap && height <= p.upper_cap)) return false;
  const Vec3 l = p.to_local.point(point);
  return p.outline.contains({l.x, l.y});
}

Vec3 sweep_normal(const PlacedOutline& p, const Ray& ray, double t) {
  const Vec3 end = end_at(p, ray, t);
  if (end != Vec3{}) return end;
  OutlineCuts cuts;
  find_cuts(p, ray, cuts);
  std::size_t i = 0;
  while (i < cuts.size() && cuts[i].t != t) ++i;
  if (i == cuts.size()) return {};
  const OutlinePoint along = cuts[i].piece->tangent(cuts[i].v);
  const Vec3 n = normalized(p.to_local.transposed_vector({along.y, -along.x, 0}));
  const bool looks_back = dot(n, ray.direction) < 0;
  return looks_back == (i % 2 == 0) ? n : -n;
}

CellSide classify_sweep(const PlacedOutline& p, const Aabb& cell) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  double low = kInf, high = -kInf;
  OutlineBox box{{kInf, kInf}, {-kInf, -kInf}};
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = near.corner(i), l = p.to_local.point(corner);
    const double height = dot(p.cap_normal, corner);
    low = std::min(low, height);
    high = std::max(high, height);
    box = {{std::min(box.lo.x, l.x), std::min(box.lo.y, l.y)},
           {std::max(box.hi.x, l.x), std::max(box.hi.y, l.y)}};
  }
  if (low > p.upper_cap || high < p.lower_cap) return CellSide::kOutside;
  if (p.outline.may_touch(box)) return CellSide::kCrosses;
  if (!p.outline.contains({0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y)}))
    return CellSide::kOutside;
  const bool is_between = low > p.lower_cap && high < p.upper_cap;
  return is_between && near == cell ? CellSide::kInside : CellSide::kCrosses;
}

}  // namespace graycube::csg
