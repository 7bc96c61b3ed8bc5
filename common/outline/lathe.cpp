#include "outline/lathe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/interval.hpp"
#include "outline/crossings.hpp"
#include "outline/cuts.hpp"

namespace graycube::csg {
namespace {

/// A line seen in the half plane (r, z), where it is a hyperbola. With the unit direction
/// (s e, c), e a unit vector across the axis and c ≥ 0, a point q of the line, k = q · e and
/// m = q × e (across the axis), the point at τ has
///   s τ = y − k,  r² = m² + y²,  h = s (z − q.z) + c k = c y.
/// So (r, z) lies on the line where h² = c² (r² − m²), on its part before the point nearest to the
/// axis where h < 0, behind it where h > 0. It lies outside of the hyperbola's bow where h² is
/// less. All that holds for c = 0 as well, where the bow is folded to a line: what crosses h = 0 at
/// r > m is then outside for an instant.
class LatheLine {
 public:
  LatheLine(const Vec3& origin, const Vec3& direction) {
    speed_ = length(direction);
    Vec3 u{direction.x / speed_, direction.y / speed_, direction.z / speed_};
    nearest_ = -dot(origin, u);
    const Vec3 q = origin + nearest_ * u;
    is_turned_ = u.z < 0;
    if (is_turned_) u = -u;
    c_ = u.z;
    c2_ = c_ * c_;
    s_ = std::sqrt(u.x * u.x + u.y * u.y);
    const double ex = s_ > 0 ? u.x / s_ : 1.0, ey = s_ > 0 ? u.y / s_ : 0.0;
    k_ = q.x * ex + q.y * ey;
    const double m = q.x * ey - q.y * ex;
    m2_ = m * m;
    z_ = q.z;
    ck_ = c_ * k_;
  }

  double s() const { return s_; }
  double c() const { return c_; }
  double c2() const { return c2_; }
  double m2() const { return m2_; }
  double h(double z) const { return s_ * (z - z_) + ck_; }
  bool is_outside(double h, double r) const { return h * h < c2_ * (r * r - m2_); }
  /// Whether a curve that goes through h = 0 is outside there.
  bool is_outside_at_turn(double r) const { return r * r > m2_; }

  /// False only if all points of the box are on one side, by the very expressions by which points
  /// are judged: these are monotonic, however they are rounded.
  bool may_cross(const OutlineBox& box) const {
    const double below = h(box.lo.y), above = h(box.hi.y);
    const double a = below * below, b = above * above;
    if (std::max(a, b) < c2_ * (box.lo.x * box.lo.x - m2_)) return false;
    if ((below < 0) != (above < 0)) return is_outside_at_turn(box.hi.x);
    return std::min(a, b) < c2_ * (box.hi.x * box.hi.x - m2_);
  }

  /// The ray's parameter of the crossing at (r, z); `side` is the sign of h.
  double parameter(double r, double z, double h, double side) const {
    const double w = r * r - m2_;
    const double root = w > 0 ? std::sqrt(w) : 0.0;
    // Both are y. Rounding the square root's argument costs r / y digits, dividing by c costs 1 /
    // c.
    const double y = c_ * r > root ? h / c_ : side * root;
    const double along = c_ * (z - z_) + s_ * (y - k_);
    return (nearest_ + (is_turned_ ? -along : along)) / speed_ + 0.0;
  }

 private:
  double speed_, nearest_, s_, c_, c2_, k_, m2_, z_, ck_;
  bool is_turned_;
};

/// A part of a piece on which h keeps its sign, with h² − c² (r² − m²), of degree 6.
struct LatheArc {
  const LatheLine* line;
  Cubic h, r;
  /// The piece's parameters of the ends.
  double from, to;
  /// The sign of h.
  double side;

  /// More than eight roundings, of a coefficient in parts of the largest products.
  static constexpr double kError = 0x1p-49;

  int changes(bool begins_negative, bool ends_negative) const {
    // (h + c r) (h − c r) + c² m².
    std::array<double, 4> p, q;
    double most_p = 0, most_q = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double cr = line->c() * r.b[i];
      p[i] = h.b[i] + cr;
      q[i] = h.b[i] - cr;
      most_p = std::max(most_p, std::fabs(p[i]));
      most_q = std::max(most_q, std::fabs(q[i]));
    }
    const double c2m2 = line->c2() * line->m2();
    const std::array<double, 7> b{
        0,
        (p[0] * q[1] + p[1] * q[0]) / 2 + c2m2,
        (p[0] * q[2] + 3 * (p[1] * q[1]) + p[2] * q[0]) / 5 + c2m2,
        (p[0] * q[3] + 9 * (p[1] * q[2] + p[2] * q[1]) + p[3] * q[0]) / 20 + c2m2,
        (p[1] * q[3] + 3 * (p[2] * q[2]) + p[3] * q[1]) / 5 + c2m2,
        (p[2] * q[3] + p[3] * q[2]) / 2 + c2m2,
        0};
    return sign_changes(b, kError * (most_p * most_q + c2m2), begins_negative, ends_negative);
  }
  std::pair<LatheArc, LatheArc> parts(double v) const {
    const auto [h0, h1] = h.split(v);
    const auto [r0, r1] = r.split(v);
    const double middle = from + v * (to - from);
    return {{line, h0, r0, from, middle, side}, {line, h1, r1, middle, to, side}};
  }
  std::pair<LatheArc, LatheArc> halves() const { return parts(0.5); }
  bool is_negative_at_end() const { return line->is_outside(h.b[3], r.b[3]); }

  // Of the polynomial's sign, but linear where it has two roots that nearly coincide at h = 0; with
  // the root, on the other hand, its slope would be infinite at r = m for steep lines.
  bool takes_root() const { return line->c() < line->s(); }
  double value(double v) const {
    const double hv = h.at(v), rv = r.at(v), w = rv * rv - line->m2();
    if (!takes_root()) return hv * hv - line->c2() * w;
    return side * hv - (w > 0 ? line->c() * std::sqrt(w) : 0.0);
  }
  double slope(double v) const {
    const double rv = r.at(v), w = rv * rv - line->m2();
    if (!takes_root()) return 2 * (h.at(v) * h.slope(v) - line->c2() * (rv * r.slope(v)));
    return side * h.slope(v) - (w > 0 ? line->c() * (rv * r.slope(v)) / std::sqrt(w) : 0.0);
  }
};

/// Where h changes its sign.
struct TurnArc {
  const Cubic& h;
  double value(double v) const { return h.at(v); }
  double slope(double v) const { return h.slope(v); }
};

void add_cuts_of_piece(const LatheLine& line, const OutlinePiece& piece, OutlineCuts& cuts) {
  LatheArc arc{&line, {}, piece.x, 0, 1, 1};
  for (std::size_t i = 0; i < 4; ++i) arc.h.b[i] = line.h(piece.y.b[i]);
  const bool begins_outside = line.is_outside(arc.h.b[0], arc.r.b[0]);
  const bool ends_outside = line.is_outside(arc.h.b[3], arc.r.b[3]);
  const bool begins_before = arc.h.b[0] < 0, ends_before = arc.h.b[3] < 0;
  const auto visit = [&](const LatheArc& part, double v) {
    const double at = part.from + v * (part.to - part.from);
    cuts.add({line.parameter(part.r.at(v), piece.y.at(at), part.h.at(v), part.side), &piece, at});
  };
  arc.side = begins_before ? -1 : 1;
  if (begins_before == ends_before)
    return each_sign_change(arc, begins_outside, ends_outside, visit);
  auto [first, second] = arc.parts(sign_change(TurnArc{arc.h}, begins_before));
  const bool is_outside = line.is_outside_at_turn(first.r.b[3]);
  first.h.b[3] = second.h.b[0] = 0;
  second.side = -arc.side;
  each_sign_change(first, begins_outside, is_outside, visit);
  each_sign_change(second, is_outside, ends_outside, visit);
}

void find_cuts(const PlacedOutline& p, const Ray& ray, OutlineCuts& cuts) {
  const LatheLine line(p.to_local.point(ray.origin), p.to_local.vector(ray.direction));
  p.outline.each_piece([&](const OutlineBox& box) { return line.may_cross(box); },
                       [&](const OutlinePiece& piece) { add_cuts_of_piece(line, piece, cuts); });
  cuts.settle();
}

double distance_from_axis(const Vec3& l) { return std::sqrt(l.x * l.x + l.y * l.y); }

}  // namespace

Spans lathe_spans(const PlacedOutline& p, const Ray& ray) {
  OutlineCuts cuts;
  find_cuts(p, ray, cuts);
  Spans spans;
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) spans.add(cuts[i].t, cuts[i + 1].t);
  return spans;
}

bool lathe_contains(const PlacedOutline& p, const Vec3& point) {
  const Vec3 l = p.to_local.point(point);
  return p.outline.contains({distance_from_axis(l), l.z});
}

Vec3 lathe_normal(const PlacedOutline& p, const Ray& ray, double t) {
  OutlineCuts cuts;
  find_cuts(p, ray, cuts);
  std::size_t i = 0;
  while (i < cuts.size() && cuts[i].t != t) ++i;
  if (i == cuts.size()) return {};
  const OutlinePoint along = cuts[i].piece->tangent(cuts[i].v);
  const Vec3 l = p.to_local.point(ray.at(t));
  const double r = distance_from_axis(l);
  const double x = r > 0 ? l.x / r : 0.0, y = r > 0 ? l.y / r : 0.0;
  const Vec3 n = normalized(p.to_local.transposed_vector({along.y * x, along.y * y, -along.x}));
  const bool looks_back = dot(n, ray.direction) < 0;
  return looks_back == (i % 2 == 0) ? n : -n;
}

CellSide classify_lathe(const PlacedOutline& p, const Aabb& cell) {
  const Aabb near = intersection_of(cell, p.bounds);
  if (near.is_empty()) return CellSide::kOutside;
  Aabb l = Aabb::nothing();
  for (int i = 0; i < 8; ++i) l.include(p.to_local.point(near.corner(i)));
  const auto farther = [](double lo, double hi) { return std::max(std::fabs(lo), std::fabs(hi)); };
  const double x = distance_to_zero(l.lo.x, l.hi.x), y = distance_to_zero(l.lo.y, l.hi.y);
  const double far_x = farther(l.lo.x, l.hi.x), far_y = farther(l.lo.y, l.hi.y);
  const OutlineBox box{{std::sqrt(x * x + y * y), l.lo.z},
                       {std::sqrt(far_x * far_x + far_y * far_y), l.hi.z}};
  if (p.outline.may_touch(box)) return CellSide::kCrosses;
  if (!p.outline.contains({0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y)}))
    return CellSide::kOutside;
  return near == cell ? CellSide::kInside : CellSide::kCrosses;
}

}  // namespace graycube::csg
