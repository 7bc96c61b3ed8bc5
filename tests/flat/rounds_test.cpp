// Disks and polygons: hulls, and offsets with exact arcs.

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "flat/offset.hpp"
#include "flat/rounds.hpp"

namespace graycube {
namespace {

bool in_disk(const FlatPoint& p, const FlatPoint& c, double r) {
  const double dx = p.x - c.x, dy = p.y - c.y;
  return dx * dx + dy * dy <= r * r;
}

bool holds(const FlatRoundHull& hull, const std::vector<FlatDisk>& disks, const FlatPoint& p) {
  if (hull.polygon.size() >= 3 && is_within(std::vector<FlatLoop>{hull.polygon}, p)) return true;
  return std::any_of(hull.disks.begin(), hull.disks.end(),
                     [&](std::size_t i) { return in_disk(p, disks[i].center, disks[i].radius); });
}

/// How far the point is beyond the hull, from many directions. If positive, the point is outside.
/// The best direction is missed by less than 1e-3, so that less than −kMissed proves that the point
/// is inside.
constexpr double kMissed = 0.02;
double beyond_hull(const std::vector<FlatDisk>& disks, const FlatPoint& p) {
  double most = -INFINITY;
  constexpr int kDirections = 3600;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * M_PI * i / kDirections;
    const FlatPoint u{std::cos(angle), std::sin(angle)};
    double reach = -INFINITY;
    for (const FlatDisk& d : disks)
      reach = std::max(reach, d.center.x * u.x + d.center.y * u.y + d.radius);
    most = std::max(most, p.x * u.x + p.y * u.y - reach);
  }
  return most;
}

TEST_CASE("a point is in the hull of disks exactly when no line keeps it out") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(-5, 5), size(0.1, 2);
    std::uniform_int_distribution<int> choice(0, 3);
    std::vector<FlatDisk> disks;
    for (std::uint64_t i = 0; i < 2 + seed % 7; ++i) {
      FlatPoint c{place(random), place(random)};
      if (choice(random) > 0) c = {std::round(c.x), std::round(c.y)};
      disks.push_back({c, choice(random) == 0 ? 0 : choice(random) < 2 ? 1 : size(random), 24});
    }
    const FlatRoundHull hull = flat_round_hull(disks);
    int wrong = 0;
    for (int i = 0; i < 100; ++i) {
      const FlatPoint p{1.5 * place(random), 1.5 * place(random)};
      const double beyond = beyond_hull(disks, p);
      const bool is_inside = holds(hull, disks, p);
      if (is_inside ? beyond > 1e-9 : beyond < -kMissed) ++wrong;
    }
    INFO("seed " << seed);
    CHECK(wrong == 0);
  }
}

TEST_CASE("tangents of equal disks are exactly where they should be") {
  const std::vector<FlatDisk> disks{{{0, 0}, 5, 30}, {{20, 0}, 5, 30}, {{10, 1}, 2, 30}};
  const FlatRoundHull hull = flat_round_hull(disks);
  CHECK(hull.disks == std::vector<std::size_t>{0, 1});
  CHECK(hull.polygon == FlatLoop{{0, -5}, {20, -5}, {20, 5}, {0, 5}});
}

TEST_CASE("of equal disks one remains, and what one disk holds is it alone") {
  CHECK(flat_round_hull(std::vector<FlatDisk>{{{1, 2}, 3, 0}, {{1, 2}, 3, 0}, {{2, 2}, 1, 0}})
            .disks == std::vector<std::size_t>{0});
}

double distance_to_side(const FlatPoint& p, const FlatPoint& a, const FlatPoint& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double share =
      std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

double distance_to_outline(const FlatLoops& loops, const FlatPoint& p) {
  double least = INFINITY;
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      least = std::min(least, distance_to_side(p, loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  return least;
}

/// A star about the origin, with a hole in every second one.
FlatLoops random_star(std::mt19937_64& random) {
  std::uniform_real_distribution<double> size(2, 6);
  std::uniform_int_distribution<int> count(3, 12);
  const int n = count(random);
  FlatLoops loops(1);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, r = size(random);
    loops[0].push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  if (n % 2 == 0) loops.push_back({{-0.3, -0.3}, {0.4, -0.3}, {0.1, 0.5}});
  return resolved(loops);
}

TEST_CASE(
    "a grown polygon holds exactly what is near it, a shrunk one what is far from its outside") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    const FlatLoops star = random_star(random);
    std::uniform_real_distribution<double> place(-8, 8), size(0.05, 1.5);
    const double distance = (seed % 2 == 0 ? 1 : -1) * size(random);
    const auto offset = round_offset(star, distance);
    REQUIRE(offset);
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
      const FlatPoint p{place(random), place(random)};
      const double to_outline = distance_to_outline(star, p);
      if (std::fabs(to_outline - std::fabs(distance)) < 1e-9) continue;
      const bool is_near = to_outline < std::fabs(distance), is_in = is_within(star, p);
      const bool expected = distance > 0 ? is_in || is_near : is_in && !is_near;
      const bool is_rounded =
          std::any_of(offset->centers.begin(), offset->centers.end(),
                      [&](const FlatPoint& c) { return in_disk(p, c, std::fabs(distance)); });
      const bool is_polygon = is_within(offset->polygon, p);
      if ((distance > 0 ? is_polygon || is_rounded : is_polygon && !is_rounded) != expected)
        ++wrong;
    }
    INFO("seed " << seed);
    CHECK(wrong == 0);
  }
}

TEST_CASE("corners of an offset lie where the moved sides cross, to the last bits") {
  const FlatLoops angle{{{0, 0}, {0.7, 0}, {0.7, 0.1}, {0.1, 0.1}, {0.1, 0.7}, {0, 0.7}}};
  const auto grown = round_offset(angle, 0.3);
  REQUIRE(grown);
  REQUIRE(grown->polygon.size() == 1);
  const FlatPoint inner{0.1 + 0.3, 0.1 + 0.3};
  const auto is_there = [&](const FlatPoint& p) {
    return std::fabs(p.x - inner.x) < 1e-15 && std::fabs(p.y - inner.y) < 1e-15;
  };
  CHECK(std::any_of(grown->polygon[0].begin(), grown->polygon[0].end(), is_there));
}

TEST_CASE("a curve made of facets is not given a disk for each of its corners") {
  FlatLoop loop;
  for (int i = 0; i < 300; ++i)
    loop.push_back({std::cos(2 * M_PI * i / 300), std::sin(2 * M_PI * i / 300)});
  CHECK_FALSE(round_offset({loop}, 0.1));
}

}  // namespace
}  // namespace graycube
