#include "flat/triangulation.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"

namespace graycube {
namespace {

FlatLoop rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

double area_of(std::span<const FlatLoop> loops, const std::vector<FlatTriangle>& triangles) {
  FlatLoop all;
  for (const FlatLoop& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
  double sum = 0;
  for (const FlatTriangle& t : triangles) {
    const FlatPoint &a = all.at(t[0]), &b = all.at(t[1]), &c = all.at(t[2]);
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    CHECK(twice > 0);
    sum += 0.5 * twice;
  }
  return sum;
}

TEST_CASE("a plate with a field of slots is cut into triangles that leave the slots open") {
  constexpr int kSide = 40;
  FlatLoops loops{rectangle(0, 0, 3 * kSide + 1, 3 * kSide + 1)};
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = 3 * (i % kSide) + 1, y = 3 * (i / kSide) + 1;
    FlatLoop slot = rectangle(x, y, x + 2, y + 2);
    loops.emplace_back(slot.rbegin(), slot.rend());
  }
  const auto triangles = triangles_of(loops);
  REQUIRE(triangles);
  // A polygon of n corners with h holes has n + 2 h − 2 triangles.
  CHECK(triangles->size() == 4 * loops.size() + 2 * (loops.size() - 1) - 2);
  const double side = 3 * kSide + 1;
  CHECK(area_of(loops, *triangles) == Approx(side * side - 4.0 * kSide * kSide));
}

TEST_CASE("stars with many corners at random distances are cut into triangles of their area") {
  constexpr std::uint64_t kSeed = 5;
  INFO("seed " << kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> reach(0.05, 1);
  for (int turn = 0; turn < 60; ++turn) {
    FlatLoop star;
    const int corners = 5 + 7 * turn;
    double area = 0;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.141592653589793 * i / corners, r = reach(random);
      star.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    for (std::size_t i = 0; i < star.size(); ++i) {
      const FlatPoint &a = star[i], &b = star[(i + 1) % star.size()];
      area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    const FlatLoops loops{star};
    const auto triangles = triangles_of(loops);
    REQUIRE(triangles);
    CHECK(triangles->size() == star.size() - 2);
    CHECK(area_of(loops, *triangles) == Approx(area));
  }
}

TEST_CASE("loops may touch at a corner") {
  const FlatLoops loops{rectangle(0, 0, 2, 2), rectangle(2, 2, 3, 3)};
  const auto triangles = triangles_of(loops);
  REQUIRE(triangles);
  CHECK(triangles->size() == 4);
  CHECK(area_of(loops, *triangles) == Approx(5));
}

TEST_CASE("sides that cross, and corners on other loops' sides, have no triangles") {
  CHECK_FALSE(triangles_of(FlatLoops{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}));
  CHECK_FALSE(triangles_of(FlatLoops{rectangle(0, 0, 4, 4), {{1, 0}, {2, 1}, {1, 1}}}));
  CHECK_FALSE(triangles_of(FlatLoops{{{0, 0}, {1, 0}}}));
}

}  // namespace
}  // namespace graycube
