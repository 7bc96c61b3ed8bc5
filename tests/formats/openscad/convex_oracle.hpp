// Whether a point lies in the hull of balls or level discs, by projecting it: an oracle that knows
// nothing of tangents.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "formats/openscad/hulls/round_hull.hpp"

namespace graycube::testing {

/// The point of the hull that is furthest in the direction u.
inline Vec3 support_point(RoundKind kind, const std::vector<RoundPoint>& points, const Vec3& u) {
  const Vec3 level = kind == RoundKind::kBalls ? u : Vec3{u.x, u.y, 0};
  const Vec3 out = normalized(level);
  Vec3 best;
  double most = -INFINITY;
  for (const RoundPoint& p : points) {
    const Vec3 at = p.center + p.radius * out;
    if (dot(at, u) > most) most = dot(at, u), best = at;
  }
  return best;
}

enum class Side { kInside, kOutside, kNear };

/// Frank & Wolfe's method, 1956, for the nearest point: a plane proves that p is outside; coming
/// within `margin` of it, that it is inside.
inline Side side_of_hull(RoundKind kind, const std::vector<RoundPoint>& points, const Vec3& p,
                         double margin) {
  Vec3 x = points.front().center;
  for (int step = 0; step < 3000; ++step) {
    const Vec3 u = p - x;
    if (length(u) < margin) return Side::kInside;
    const Vec3 s = support_point(kind, points, u);
    if (dot(p - s, u) > 2 * margin * length(u)) return Side::kOutside;
    const Vec3 d = s - x;
    const double share = dot(d, d) > 0 ? std::min(1.0, std::max(0.0, dot(u, d) / dot(d, d))) : 0;
    x = x + share * d;
  }
  return Side::kNear;
}

inline std::vector<RoundPoint> random_rounds(std::mt19937_64& random, std::size_t count,
                                             RoundKind kind) {
  std::uniform_real_distribution<double> place(-5, 5), size(0.1, 2);
  std::uniform_int_distribution<int> choice(0, 5), level(0, 2);
  const double common = size(random);
  std::vector<RoundPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 c{place(random), place(random), place(random)};
    // Grids and common heights give planes that touch many points.
    if (choice(random) < 3) c = {std::round(c.x), std::round(c.y), std::round(c.z)};
    if (kind == RoundKind::kDiscs && choice(random) < 4) c.z = 2.0 * level(random);
    const int which = choice(random);
    points.push_back({c, which == 0 ? 0 : which < 4 ? common : size(random)});
  }
  points.front().radius = common;
  return points;
}

}  // namespace graycube::testing
