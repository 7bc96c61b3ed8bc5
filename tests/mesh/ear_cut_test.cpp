// Cutting ears off polygons of the plane.
#include "mesh/ear_cut.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "mesh/face_point.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A polygon about the origin with as many spikes, of any lengths, as it has corners.
std::vector<FacePoint> spikes(std::uint32_t corners, Dice& dice) {
  std::vector<FacePoint> polygon;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = i % 2 == 0 ? dice.between(50, 100) : dice.between(1, 50);
    polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return polygon;
}

double area(std::span<const FacePoint> polygon) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += turn(polygon[0], polygon[i], polygon[i + 1]);
  return sum / 2;
}

}  // namespace

TEST_CASE("ears that are cut off cover the polygon once, wherever its corners lie") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Dice dice(seed);
    const auto corners = static_cast<std::uint32_t>(4 + dice.below(200));
    INFO("seed " << seed << ", " << corners << " corners");
    const std::vector<FacePoint> polygon = spikes(corners, dice);
    std::vector<Triangle> triangles;
    cut_ears(polygon, triangles);
    REQUIRE(triangles.size() == corners - 2);
    double covered = 0;
    for (const auto& [a, b, c] : triangles) {
      const double twice = turn(polygon[a], polygon[b], polygon[c]);
      REQUIRE(twice > 0);
      covered += twice / 2;
    }
    REQUIRE(covered == Approx(area(polygon)).epsilon(1e-12));
  }
}
