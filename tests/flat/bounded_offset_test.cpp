#include "flat/bounded_offset.hpp"

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "flat/loop_area.hpp"
#include "flat/side_crossings.hpp"
#include "flat/simple_outlines.hpp"

namespace graycube {
namespace {

using testing::area;
using testing::Dice;

/// A ring of `corners` about the origin whose radii are 100, up to `roughness` more or less.
FlatLoop rough_ring(int corners, double roughness, Dice& dice) {
  FlatLoop ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = 100 + dice.between(-roughness, roughness);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

FlatLoop square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

TEST_CASE("an offset in steps is the figure that one operation gives") {
  const auto join = GENERATE(FlatJoin::kRound, FlatJoin::kMiter, FlatJoin::kSquare);
  const double distance = GENERATE(20.0, 300.0, -20.0, -60.0);
  Dice dice(11);
  FlatLoops figure{rough_ring(500, 3, dice)};
  FlatLoop hole = rough_ring(40, 5, dice);
  for (FlatPoint& p : hole) p = {0.1 * p.x, 0.1 * p.y};
  figure.push_back(FlatLoop(hole.rbegin(), hole.rend()));
  const double tolerance = 0.02 * std::fabs(distance);
  const auto stepped = swept_offset(figure, distance, join, tolerance);
  REQUIRE(stepped);
  const double expected = area(offset(figure, distance, join, tolerance));
  CHECK(std::fabs(area(*stepped) - expected) <= 1e-8 * (expected + 1));
}

TEST_CASE("offsets that reach far beyond a figure of thousands of corners are found") {
  Dice dice(12);
  const FlatLoops figure{rough_ring(5000, 2, dice)};
  // Nearly a disk with OpenSCAD's facets about each corner, within a hundredth of its radius.
  const auto grown = bounded_offset(figure, 1000, FlatJoin::kRound, 10);
  REQUIRE(grown);
  CHECK(area(*grown) == Approx(std::numbers::pi * 1101 * 1101).epsilon(0.02));
  const auto shrunk = bounded_offset(figure, -60, FlatJoin::kRound, 0.6);
  REQUIRE(shrunk);
  CHECK(area(*shrunk) == Approx(std::numbers::pi * 38.5 * 38.5).epsilon(0.05));
  const auto gone = bounded_offset(figure, -110, FlatJoin::kMiter, 1);
  REQUIRE(gone);
  CHECK(gone->empty());
}

TEST_CASE("offsets with more corners or crossings than their limits are refused") {
  Dice dice(13);
  const FlatLoops wild{rough_ring(40000, 5, dice)};
  CHECK_FALSE(bounded_offset(wild, 1000, FlatJoin::kRound, 1e-3));
  const FlatLoops plain{square(0, 0, 1)};
  CHECK(bounded_offset(plain, 1, FlatJoin::kRound, 1e-3));
}

TEST_CASE("a figure of 100 000 corners that meet nowhere is as it is, turned and nested") {
  Dice dice(14);
  FlatLoop outer = rough_ring(100000, 0.001, dice), hole = rough_ring(5000, 0.001, dice);
  for (FlatPoint& p : hole) p = {0.5 * p.x, 0.5 * p.y};
  const double ring = std::fabs(area({outer})) - std::fabs(area({hole}));
  const FlatLoops figure{hole, square(-1, -1, 2), FlatLoop(outer.rbegin(), outer.rend())};
  const auto regions = simple_regions(figure);
  REQUIRE(regions);
  REQUIRE(regions->size() == 2);
  CHECK(regions->at(0).holes.empty());
  CHECK(area({regions->at(0).outline}) == 4);
  REQUIRE(regions->at(1).holes.size() == 1);
  CHECK(area({regions->at(1).outline}) > 0);
  CHECK(area({regions->at(1).holes.front()}) < 0);
  CHECK(area(loops_of(*regions)) == Approx(ring + 4));
  CHECK(area(resolved(figure)) == Approx(ring + 4));
  CHECK(regions_of(figure).size() == 2);
}

TEST_CASE("outlines that cross or touch are told from those that don't") {
  const FlatLoop big = square(0, 0, 10);
  CHECK(simple_regions({big, square(2, 2, 3), square(6, 6, 3)}));
  CHECK(simple_regions({square(0, 0, 1), square(2, 0, 1)})->size() == 2);
  CHECK_FALSE(simple_regions({big, square(5, 5, 10)}));
  CHECK_FALSE(simple_regions({big, square(10, 3, 2)}));
  CHECK_FALSE(simple_regions({big, square(10, 10, 2)}));
  CHECK_FALSE(simple_regions({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}));
  CHECK_FALSE(simple_regions({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}));
  CHECK_FALSE(simple_regions({{{0, 0}, {4, 0}, {2, 0}, {2, 5}}}));
}

TEST_CASE("random outlines are simple where no two of their sides cross") {
  const auto seed = GENERATE(range(1, 300));
  Dice dice(static_cast<std::uint64_t>(seed));
  FlatLoop loop;
  for (int i = 0; i < 5; ++i) loop.push_back({dice.between(0, 1), dice.between(0, 1)});
  std::size_t none = 0;
  const FlatLoops figure{loop};
  CHECK(simple_regions(figure).has_value() == crossings_are_few(std::span(&figure, 1), none));
}

}  // namespace
}  // namespace graycube
