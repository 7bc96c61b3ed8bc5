#include "formats/openscad/hulls/round_hull.hpp"

#include <algorithm>
#include <cmath>

#include "flat/circle_arcs.hpp"

namespace graycube {
namespace {

/// Rounding errors, relative to the extent of all points.
constexpr double kRounding = 1e-11;
/// Planes that differ by less touch the same points.
constexpr double kOnePlane = 1e-9;

/// The directions u = middle + x · across + y · upright for points (x, y) of the unit circle.
struct DirectionCircle {
  Vec3 middle, across, upright;
  Vec3 at(const FlatPoint& p) const { return middle + p.x * across + p.y * upright; }
};

Vec3 any_normal_to(const Vec3& v) {
  const Vec3 a{std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
  const Vec3 axis = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0}
                    : a.y <= a.z             ? Vec3{0, 1, 0}
                                             : Vec3{0, 0, 1};
  return normalized(cross(v, axis));
}

class HullBuilder {
 public:
  HullBuilder(RoundKind kind, std::vector<RoundPoint> points)
      : kind_(kind), points_(std::move(points)) {
    for (const RoundPoint& p : points_) {
      extent_ = std::max(extent_, p.radius + max_abs(p.center - points_.front().center));
    }
  }

  RoundHull build() {
    shows_.assign(points_.size(), points_.size() == 1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!(points_[i].radius > 0)) hull_.core.push_back(points_[i].center);
      for (std::size_t j = i + 1; j < points_.size(); ++j) bridge(i, j);
    }
    for (std::size_t i = 0; kind_ == RoundKind::kBalls && i < points_.size(); ++i) {
      if (shows_[i] && points_[i].radius > 0) hull_.corners.push_back(i);
    }
    hull_.kind = kind_;
    hull_.points = std::move(points_);
    return std::move(hull_);
  }

 private:
  /// The length by which directions are scaled.
  double size_of(const Vec3& u) const {
    return kind_ == RoundKind::kBalls ? length(u) : length({u.x, u.y, 0});
  }
  Vec3 touching_point(std::size_t i, const Vec3& u) const {
    return points_[i].center +
           points_[i].radius * (kind_ == RoundKind::kBalls ? u : Vec3{u.x, u.y, 0});
  }
  double reach(std::size_t i, const Vec3& u) const {
    return dot(points_[i].center, u) + points_[i].radius;
  }

  /// The directions in which both reach equally far; nothing when one holds the other, or for discs
  /// at one height.
  std::optional<DirectionCircle> equal_directions(std::size_t i, std::size_t j) const {
    const Vec3 d = points_[j].center - points_[i].center;
    const double narrowing = points_[i].radius - points_[j].radius;
    if (kind_ == RoundKind::kDiscs) {
      if (!(std::fabs(d.z) > kRounding * extent_)) return std::nullopt;
      return DirectionCircle{{0, 0, narrowing / d.z}, {1, 0, -d.x / d.z}, {0, 1, -d.y / d.z}};
    }
    const double distance = length(d);
    if (!(distance > std::fabs(narrowing))) return std::nullopt;
    const Vec3 axis = normalized(d), across = any_normal_to(axis);
    const double cosine = narrowing / distance, sine = std::sqrt((1 - cosine) * (1 + cosine));
    return DirectionCircle{cosine * axis, sine * across, sine * cross(axis, across)};
  }

  void bridge(std::size_t i, std::size_t j) {
    if (!(points_[i].radius > 0) && !(points_[j].radius > 0)) return;
    const auto circle = equal_directions(i, j);
    if (!circle) return;
    CircleArcs arcs;
    for (std::size_t k = 0; k < points_.size() && !arcs.is_empty(); ++k) {
      if (k == i || k == j) continue;
      const Vec3 d = points_[k].center - points_[i].center;
      arcs.keep(dot(d, circle->across), dot(d, circle->upright),
                points_[i].radius - points_[k].radius - dot(d, circle->middle), kRounding * extent_,
                k);
    }
    if (arcs.is_empty()) return;
    hull_.bridges.emplace_back(i, j);
    shows_[i] = shows_[j] = true;
    for (const CircleArcs::Arc& arc : arcs.arcs()) {
      if (arc.is_whole()) continue;
      for (const CircleArcs::End* end : {&arc.from, &arc.to}) {
        add_plane(plane_of({i, j, end->cutter}, circle->at(end->direction)));
      }
    }
  }

  /// The direction near `guess` in which three points reach equally far. With e, f the differences
  /// of the centres and a, b those of the radii, e · u = a and f · u = b give u = α + β n, n = e ×
  /// f; the scale gives β.
  Vec3 plane_of(const std::array<std::size_t, 3>& which, const Vec3& guess) const {
    const RoundPoint &p = points_[which[0]], &q = points_[which[1]], &r = points_[which[2]];
    const Vec3 e = q.center - p.center, f = r.center - p.center, n = cross(e, f);
    if (!(length(n) > kOnePlane * length(e) * length(f))) return guess;
    const Vec3 normal = normalized(n);
    const double a = p.radius - q.radius, b = p.radius - r.radius;
    if (a == 0 && b == 0) return (dot(guess, normal) < 0 ? -1 : 1) / size_of(normal) * normal;
    const Vec3 offset = (1 / length(n)) * (a * cross(f, normal) + b * cross(normal, e));
    const bool is_ball = kind_ == RoundKind::kBalls;
    const Vec3 level_offset = is_ball ? offset : Vec3{offset.x, offset.y, 0};
    const Vec3 level_normal = is_ball ? normal : Vec3{normal.x, normal.y, 0};
    const double n2 = dot(level_normal, level_normal), mixed = dot(level_offset, level_normal);
    const double root =
        std::sqrt(std::max(0.0, mixed * mixed - n2 * (dot(level_offset, level_offset) - 1)));
    const Vec3 plus = offset + ((root - mixed) / n2) * normal,
               minus = offset + ((-root - mixed) / n2) * normal;
    return length(plus - guess) <= length(minus - guess) ? plus : minus;
  }

  /// Three of the points that the plane touches, far from one another, determine its numbers, so
  /// that each plane is found once.
  void add_plane(Vec3 u) {
    const double own = most_reach(u), allowed = kOnePlane * extent_;
    std::vector<std::size_t> touched;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (reach(k, u) >= own - allowed) touched.push_back(k);
    }
    if (touched.size() > 2) u = plane_of(far_apart(touched), u);
    const double size = length(u);
    HalfSpaceShape plane{(1 / size) * u + Vec3{}, 0};
    plane.offset = dot(plane.normal, points_[touched.front()].center) +
                   points_[touched.front()].radius / size + 0.0;
    const bool is_known =
        std::any_of(hull_.planes.begin(), hull_.planes.end(), [&](const HalfSpaceShape& other) {
          return max_abs(other.normal - plane.normal) <= kOnePlane &&
                 std::fabs(other.offset - plane.offset) <= allowed;
        });
    if (is_known) return;
    hull_.planes.push_back(plane);
    for (const std::size_t k : touched) {
      if (points_[k].radius > 0) hull_.core.push_back(touching_point(k, u));
    }
  }

  double most_reach(const Vec3& u) const {
    double most = reach(0, u);
    for (std::size_t k = 1; k < points_.size(); ++k) most = std::max(most, reach(k, u));
    return most;
  }

  std::array<std::size_t, 3> far_apart(const std::vector<std::size_t>& touched) const {
    std::array<std::size_t, 3> best{touched[0], touched[1], touched[2]};
    const Vec3 origin = points_[best[0]].center;
    double most = -1;
    for (const std::size_t k : touched) {
      const double distance = length(points_[k].center - origin);
      if (distance > most) most = distance, best[1] = k;
    }
    most = -1;
    for (const std::size_t k : touched) {
      const double area =
          length(cross(points_[best[1]].center - origin, points_[k].center - origin));
      if (area > most) most = area, best[2] = k;
    }
    return best;
  }

  RoundKind kind_;
  std::vector<RoundPoint> points_;
  std::vector<bool> shows_;
  double extent_ = 0;
  RoundHull hull_;
};

}  // namespace

std::optional<RoundHull> round_hull(RoundKind kind, std::vector<RoundPoint> points) {
  points = without_hidden(kind, std::move(points));
  const auto is_round = [](const RoundPoint& p) { return p.radius > 0; };
  const auto round =
      static_cast<std::size_t>(std::count_if(points.begin(), points.end(), is_round));
  if (round > kMaxRoundPoints || points.size() > kMaxHullPoints) return std::nullopt;
  if (round * points.size() * points.size() > kMaxHullArcs) return std::nullopt;
  return HullBuilder(kind, std::move(points)).build();
}

}  // namespace graycube
