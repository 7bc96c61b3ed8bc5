// Scenes that must be everything within a distance of a solid.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"
#include "formats/pov/scene_membership.hpp"

namespace graycube::testing {

/// The distance of a point from a solid, 0 inside.
using Distance = std::function<double(const Vec3&)>;

inline double from_box(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  Vec3 d;
  for (int a = 0; a < 3; ++a) d[a] = std::max({lo[a] - p[a], 0.0, p[a] - hi[a]});
  return length(d);
}

/// A radius for a solid that is the scene itself: more than the rounding that is allowed.
inline constexpr double kItself = 2e-9;

/// The scene must be everything within `radius` of the solid.
inline void check_within(const std::string& text, const Distance& distance, double radius) {
  INFO(text);
  CHECK(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  constexpr std::uint64_t kSeed = 17;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-4, 16);
  int wrong = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{place(random), place(random), place(random)};
    const double d = distance(p) - radius;
    if (std::fabs(d) < 1e-9) continue;
    inside += d < 0 ? 1 : 0;
    wrong += any_object_holds(scene, p) == (d < 0) ? 0 : 1;
  }
  INFO("seed " << kSeed);
  CHECK(wrong == 0);
  CHECK(inside > 100);
}

inline const std::string kMoved =
    "multmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) ";
inline const std::string kAngle =
    "polygon(points = [[0, 0], [10, 0], [10, 3], [3, 3], [3, 10], [0, 10]])";

inline double from_angle(const Vec3& p) {
  return std::min(from_box(p, {0, 0, 0}, {10, 3, 5}), from_box(p, {0, 0, 0}, {3, 10, 5}));
}
inline double from_flat_angle(const Vec3& p) { return from_angle({p.x, p.y, 1}); }

}  // namespace graycube::testing
