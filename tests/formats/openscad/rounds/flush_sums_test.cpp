// Minkowski sums that have an exact form take OpenSCAD's facets where they are flush with such.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "catch.hpp"
#include "flat/polygon.hpp"
#include "formats/openscad/hulls/ring_sums.hpp"
#include "formats/openscad/random_rays.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

constexpr std::uint64_t kSeed = 31;

const std::string kBox = "cube(size = [10, 8, 6], center = false); ";
const std::string kBall = "sphere($fn = 24, r = 2); ";
const std::string kPost = "cylinder($fn = 24, h = 3, r1 = 2, r2 = 2); ";
const std::string kAngle =
    "linear_extrude(height = 4) polygon(points = [[0, 0], [10, 0], [10, 3], [3, 3], [3, 10], [0, "
    "10]]); ";

std::string sum(const std::string& operands) { return "minkowski() { " + operands + "} "; }
std::string at_corner(const std::string& part) {
  return "multmatrix([[1, 0, 0, 10], [0, 1, 0, 8], [0, 0, 1, 6], [0, 0, 0, 1]]) " + part;
}

TEST_CASE("nothing is left of an exact sum that a faceted hull of it is taken from") {
  const std::string drum = "cylinder($fn = 24, h = 5, r1 = 6, r2 = 6); ";
  const std::string cone = "cylinder($fn = 24, h = 5, r1 = 6, r2 = 3); ";
  const std::string slot = "hull() { " + drum + at_corner(drum) + "} ";
  for (const std::string& operands :
       {kBox + kBall, kBox + kPost, kBox + cone, drum + kPost, drum + kBall, cone + kPost,
        cone + kBall, kBall + cone, drum + "cylinder($fn = 30, h = 1, r1 = 2, r2 = 2); ",
        "sphere($fn = 24, r = 5); " + kBall, slot + kPost, kBox + kPost + drum,
        sum(kBox + kBall) + kBall})
    check_flush(sum(operands), hull_of(sum(operands)), kSeed);
}

TEST_CASE("a rounded box is flush with a ball or a post at one of its corners") {
  const std::string ball = at_corner(kBall);
  CHECK(rays_that_hit("difference() { " + ball + sum(kBox + kBall) + hull_of(ball) + "}", kSeed) ==
        0);
  CHECK_FALSE(has_round("union() { " + sum(kBox + kBall) + hull_of(ball) + "}"));
  // All of the sum gets facets, and so does what is flush with that elsewhere.
  CHECK_FALSE(has_round("union() { " + sum(kBox + kBall) + kBall + hull_of(ball) + "}"));
  CHECK_FALSE(
      has_round("union() { " + sum(kBox + kPost) + kPost + hull_of(at_corner(kPost)) + "}"));
}

TEST_CASE("a sum stays exact beside what is exact, or of facets but not flush with it") {
  CHECK(has_round("union() { " + sum(kBox + kBall) + at_corner(kBall) + "}"));
  CHECK(has_round("union() { " + sum(kBox + kBall) + hull_of(at_corner("sphere(2.1, $fn = 24); ")) +
                  "}"));
  CHECK(has_round("union() { " + sum(kBox + kPost) + hull_of(kBox) + "}"));
}

TEST_CASE("extrusions in a sum within a hull keep their own figures") {
  const std::string prism =
      "linear_extrude(height = 2) polygon(points = [[0, 0], [7, 0], [5, 5], [0, 7]]); ";
  const std::string drum = "linear_extrude(height = 3) circle($fn = 24, r = 5); ";
  const std::string ball = "sphere($fn = 20, r = 1); ";
  // With a ball within there is no exact hull of what has a round side; of what has none there is.
  CHECK_FALSE(has_round("hull() { " + sum(prism + drum) + ball + "}"));
  CHECK_FALSE(has_round("hull() { " + sum(drum + prism) + ball + "}"));
  CHECK(has_round("hull() { " + sum(prism + prism) +
                  "multmatrix([[1, 0, 0, -2], [0, 1, 0, 0], [0, 0, 1, 0]]) " + ball + "}"));
}

TEST_CASE("sums of prisms, and of flat shapes, are flush with others of the same sides") {
  const std::string flat =
      "linear_extrude(height = 4) minkowski() { square(size = [10, 8]); circle($fn = 24, r = 2); "
      "} ";
  check_flush(flat, hull_of(flat), kSeed);
  // The post at one corner is flush with the hull, that at the other only with the sum.
  const std::string other = "multmatrix([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0]]) " + kPost;
  for (const std::string& whole : {flat, sum(kAngle + kPost)}) {
    const std::string both = "union() { " + whole + hull_of(kPost) + "} ";
    CHECK_FALSE(has_round("union() { " + other + both + "}"));
    CHECK(rays_that_hit("difference() { " + other + both + "}", kSeed) == 0);
    CHECK(has_round("union() { " + other + whole + "}"));
  }
}

/// A cylinder about a turned axis, its corners turned by an angle about it.
const Affine kTurn = rotation({1, 2, 3}, 40);
RoundRing ring_of(double radius, int sides, double start, const FlatPoint& center) {
  const FlatMap disk{{{{radius, 0, center.x}, {0, radius, center.y}}}};
  return cylinder_ring(disk, whole_ring(sides, start), kTurn);
}

double area_of(const FlatLoop& loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

FlatPoint turned_back(const Vec3& p) {
  const Vec3 q = kTurn.inverse().value().vector(p);
  return {q.x, q.y};
}

TEST_CASE("the ring of two cylinders' sum goes round the hull of all sums of their corners") {
  std::mt19937_64 random(kSeed);
  INFO("seed " << kSeed);
  std::uniform_int_distribution<int> sides(3, 40), turns(0, 3);
  std::uniform_real_distribution<double> size(0.1, 5), place(-9, 9);
  const auto any_ring = [&](double start) {
    return ring_of(size(random), sides(random), start, {place(random), place(random)});
  };
  for (int i = 0; i < 200; ++i) {
    const double start_of_a = 30 * turns(random);
    const RoundRing a = any_ring(start_of_a), b = any_ring(30 * turns(random));
    std::vector<FlatPoint> all;
    for (const Vec3& p : a.corners) {
      for (const Vec3& q : b.corners) all.push_back(turned_back(p + q));
    }
    const auto sum = sum_of(a, b, {}, 1e-9);
    REQUIRE(sum);
    FlatLoop ring;
    for (const Vec3& corner : sum->corners) {
      const FlatPoint p = ring.emplace_back(turned_back(corner));
      CHECK(std::any_of(all.begin(), all.end(), [&](const FlatPoint& q) {
        return std::hypot(p.x - q.x, p.y - q.y) < 1e-12;
      }));
    }
    CHECK(area_of(ring) == Approx(area_of(flat_hull(all))).epsilon(1e-12));
    // Sides that are parallel are one.
    CHECK(ring.size() <= a.corners.size() + b.corners.size());
    const RoundRing wider = ring_of(7.3, static_cast<int>(a.corners.size()), start_of_a, {1, 2});
    CHECK(sum_of(a, wider, {}, 1e-9)->corners.size() == a.corners.size());
  }
}

TEST_CASE("the sum of rings whose sides have no products within doubles' range ends") {
  const RoundRing a = ring_of(1e200, 24, 0, {0, 0}), b = ring_of(1e199, 30, 7, {0, 0});
  const auto sum = sum_of(a, b, {}, 1e-9);
  CHECK((!sum || sum->corners.size() <= a.corners.size() + b.corners.size()));
}

}  // namespace
}  // namespace graycube
