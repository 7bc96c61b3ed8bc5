#include "formats/brlcad/solid_chart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/brlcad/arb_corners.hpp"
#include "formats/brlcad/half_checker.hpp"

namespace graycube::brlcad {
namespace {

/// From a half-space's u = 0 to its u = 1, in mm.
constexpr double kHalfSpaceUnit = 5000;
/// rt takes directions whose cosine is below this for perpendicular.
constexpr double kPerpendicular = 1e-3;

/// The unit vector that rt (libbn's bn_vec_ortho) takes across v: at right angles to the axis that
/// is least along v, too.
Vec3 ortho(const Vec3& v) {
  const auto size = [&](int axis) { return std::fabs(v[axis]); };
  int least = size(1) < size(0) ? 1 : 0;
  if (size(2) < size(least)) least = 2;
  const int next = (least + 1) % 3, last = (least + 2) % 3;
  Vec3 out;
  out[next] = -v[last];
  out[last] = v[next];
  return normalized(out);
}

using MaybeChart = std::optional<Chart>;

/// The chart of a solid that stands in the frame of these axes.
MaybeChart chart_in(ChartKind kind, const Affine& solid_to_world) {
  const auto to_solid = solid_to_world.inverse();
  // Scenes hold invertible maps only, and rounding may take that from an extreme one.
  if (!to_solid || !to_solid->is_finite() || !to_solid->inverse()) return std::nullopt;
  Chart chart;
  chart.kind = kind;
  chart.maps = {*to_solid};
  return chart;
}

MaybeChart round_chart(const Affine& solid_to_world, EndChart base, EndChart top) {
  auto chart = chart_in(ChartKind::kRound, solid_to_world);
  if (chart) chart->ends = {base, top};
  return chart;
}

MaybeChart ell_chart(const Values& p) {
  return chart_in(ChartKind::kSphere, frame(p.vector(1), p.vector(2), p.vector(3), p.point(0)));
}

/// A right elliptic cylinder (rt's rec) counts u from B, other cones from behind A.
bool is_right_cylinder(const Vec3& h, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto cosine = [](const Vec3& v, const Vec3& w) {
    return std::fabs(dot(v, w)) / (length(v) * length(w));
  };
  return length(a - c) <= kEqualRatio * length(a) && length(b - d) <= kEqualRatio * length(b) &&
         cosine(a, b) < kPerpendicular && cosine(h, a) < kPerpendicular &&
         cosine(h, b) < kPerpendicular;
}

MaybeChart tgc_chart(const Values& p, double grow) {
  Vec3 v = p.point(0), h = p.vector(1);
  Vec3 a = p.vector(2), b = p.vector(3), c = p.vector(4), d = p.vector(5);
  const double size = std::fmax(std::fmax(length(a), length(b)), std::fmax(length(c), length(d)));
  if (is_zero(a, size) || is_zero(b, size)) {
    v = v + h;
    h = -h;
    std::swap(a, c);
    std::swap(b, d);
  }
  const double e = grow / std::fabs(dot(h, normalized(cross(a, b))));
  const Vec3 base = v - e * h, axis = (1 + 2 * e) * h;
  const Affine from =
      is_right_cylinder(h, a, b, c, d) ? frame(b, a, axis, base) : frame(-a, -b, axis, base);
  auto chart = round_chart(from, EndChart::kZeroAtRim, EndChart::kOneAtRim);
  if (chart) chart->top_radii = {length(c) / length(a), length(d) / length(b)};
  return chart;
}

/// The axes of a torus: the direction of its axis, and across it where u or v is 0. Under a map
/// that scales unevenly they are those of the torus before it.
struct Ring {
  Vec3 x, y, z;
};
Ring ring_axes(const Values& p) {
  const Vec3 own = normalized(p.raw(1));
  const auto back = p.map.inverse();
  const Vec3 start = back ? back->vector(ortho(normalized(p.vector(1)))) : ortho(own);
  const Vec3 x = normalized(start - dot(start, own) * own);
  const Vec3 y = p.map.determinant() < 0 ? cross(x, own) : cross(own, x);
  return {x, y, own};
}

MaybeChart tor_chart(const Values& p) {
  const double r = p.number(6);
  const auto [x, y, z] = ring_axes(p);
  return chart_in(ChartKind::kTorus, compose(p.map, frame(-r * x, -r * y, r * z, p.raw(0))));
}

/// An eto's u goes about its ring, and the other way; v is its longitude.
MaybeChart eto_chart(const Values& p) {
  const double r = p.number(9);
  const auto [x, y, z] = ring_axes(p);
  return chart_in(ChartKind::kTorus, compose(p.map, frame(r * x, r * y, -r * z, p.raw(0))));
}

MaybeChart half_chart(const Values& p) {
  const Vec3 own = p.raw(0);
  const Vec3 normal = normalized(p.map.vector(own));
  const Vec3 x = across(normal);
  const Vec3 center = dot(normal, p.map.point(p.number(3) * own)) * normal;
  return chart_in(ChartKind::kPlane,
                  frame(kHalfSpaceUnit * x, kHalfSpaceUnit * normalized(cross(x, normal)),
                        kHalfSpaceUnit * normal, center));
}

/// v goes from the end of one ball to that of the other, u about the axis.
MaybeChart part_chart(const Values& p) {
  const Vec3 v = p.point(0), h = p.vector(1);
  const double rv = p.number(6) * p.scale(), rh = p.number(7) * p.scale(), l = length(h);
  if (!(l > 0)) return std::nullopt;
  const double slope = (rv - rh) / l;
  const double sine = slope * slope > 1 ? 1 : std::sqrt(1 - slope * slope);
  const double before = rv / sine / l, behind = rh / sine / l;
  const Vec3 x = ortho(h), y = cross(normalized(h), x);
  const double r = std::fmax(rv, rh);
  return round_chart(frame(r * x, r * y, (1 + before + behind) * h, v - before * h),
                     EndChart::kNone, EndChart::kNone);
}

MaybeChart bowl_chart(const Values& p, double grow) {
  const Vec3 h = p.vector(1), a = normalized(p.vector(2)), up = normalized(h);
  const double r1 = p.number(9) * p.scale(), r2 = p.number(10) * p.scale();
  return round_chart(frame(r2 * normalized(cross(h, a)), r1 * a, h, p.point(0) - grow * up),
                     EndChart::kZeroAtRim, EndChart::kNone);
}

MaybeChart hyp_chart(const Values& p, double grow) {
  const Vec3 h = p.vector(1), a = p.vector(2), up = normalized(h);
  const double b = p.number(9) * p.scale();
  return round_chart(
      frame(-b * normalized(cross(h, a)), a, h + 2 * grow * up, p.point(0) - grow * up),
      EndChart::kOneAtRim, EndChart::kZeroAtRim);
}

MaybeChart trough_chart(const Values& p, double grow) {
  const Vec3 h = p.vector(1), b = p.vector(2), along = normalized(h), down = normalized(b);
  const double r = p.number(9) * p.scale();
  return chart_in(ChartKind::kTrough, frame(h + 2 * grow * along, r * normalized(cross(b, h)), b,
                                            p.point(0) - grow * along - grow * down));
}

/// u along the first edge of a face and v across it, so that the face's corners lie within 0 … 1;
/// z is the distance from its plane. Nothing for a face without area.
std::optional<Affine> face_map(const std::vector<Vec3>& corners) {
  const Vec3& first = corners[0];
  const Vec3 u = normalized(corners[1] - first);
  std::size_t third = 2;
  Vec3 across_u;
  for (; third < corners.size(); ++third) {
    const Vec3 to = corners[third] - first;
    across_u = to - dot(to, u) * u;
    if (!is_zero(across_u, length(to))) break;
  }
  if (third == corners.size()) return std::nullopt;
  const Vec3 v = normalized(across_u), n = cross(u, v);
  double lo[2] = {0, 0}, hi[2] = {0, 0};
  for (const Vec3& corner : corners) {
    const double at[2] = {dot(corner - first, u), dot(corner - first, v)};
    for (int i : {0, 1}) {
      lo[i] = std::fmin(lo[i], at[i]);
      hi[i] = std::fmax(hi[i], at[i]);
    }
  }
  const Vec3 row_u = (1 / (hi[0] - lo[0])) * u, row_v = (-1 / (hi[1] - lo[1])) * v;
  const Vec3 origin = first + lo[0] * u + lo[1] * v;
  Affine map;
  map.m = {{{row_u.x, row_u.y, row_u.z, -dot(row_u, origin)},
            {row_v.x, row_v.y, row_v.z, 1 - dot(row_v, origin)},
            {n.x, n.y, n.z, -dot(n, origin)}}};
  return map.is_finite() && map.inverse() ? std::optional(map) : std::nullopt;
}

MaybeChart arb_chart(const Values& p) {
  Chart chart;
  chart.kind = ChartKind::kFaces;
  const ArbCorners corners(p);
  for (const ArbFace& face : kArbFaces) {
    const std::vector<Vec3> distinct = corners.distinct(face);
    if (distinct.size() < 3) continue;
    if (const auto map = face_map(distinct)) chart.maps.push_back(*map);
  }
  return chart.maps.empty() ? std::nullopt : MaybeChart(chart);
}

MaybeChart chart_of(const Values& p, BrlcadKind kind, double grow) {
  switch (kind) {
    case BrlcadKind::kArb8: return arb_chart(p);
    case BrlcadKind::kTgc: return tgc_chart(p, grow);
    case BrlcadKind::kEll: return ell_chart(p);
    case BrlcadKind::kTor: return tor_chart(p);
    case BrlcadKind::kHalf: return half_chart(p);
    case BrlcadKind::kRpc:
    case BrlcadKind::kRhc: return trough_chart(p, grow);
    case BrlcadKind::kEpa:
    case BrlcadKind::kEhy: return bowl_chart(p, grow);
    case BrlcadKind::kHyp: return hyp_chart(p, grow);
    case BrlcadKind::kEto: return eto_chart(p);
    case BrlcadKind::kPart: return part_chart(p);
    case BrlcadKind::kSuperell:
    case BrlcadKind::kArbn:
    case BrlcadKind::kPipe:
    case BrlcadKind::kArs:
    case BrlcadKind::kBot: break;
  }
  return std::nullopt;
}

}  // namespace

bool has_no_chart(BrlcadKind kind) {
  return kind == BrlcadKind::kSuperell || kind == BrlcadKind::kArbn || kind == BrlcadKind::kPipe ||
         kind == BrlcadKind::kArs || kind == BrlcadKind::kBot;
}

std::optional<Pattern> laid_on(const Pattern& on_surface, const BrlcadSolid& solid,
                               const Affine& to_world, double grow) {
  if (auto squares = half_space_checker(on_surface, solid, to_world)) return squares;
  auto chart = chart_of(Values{solid.values, to_world}, solid.kind, grow);
  if (!chart) return std::nullopt;
  Pattern pattern = on_surface;
  pattern.chart = std::move(*chart);
  if (solid.kind == BrlcadKind::kEto) {
    Affine exchange;
    exchange.m = {{{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 1, 0}}};
    pattern.to_pattern = compose(pattern.to_pattern, exchange);
  }
  return pattern;
}

}  // namespace graycube::brlcad
