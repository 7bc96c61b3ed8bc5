#include "flat/polygon.hpp"

#include <cmath>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "flat/loop_area.hpp"
#include "flat/side_crossings.hpp"

namespace graycube {
namespace {

using testing::area;
using testing::Dice;

FlatLoop square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

FlatLoops combine(FlatOperation operation, const FlatLoops& a, const FlatLoops& b) {
  const FlatLoops both[] = {a, b};
  return combined(operation, both);
}

TEST_CASE("orientation is exact where rounding would hide it") {
  const double tiny = std::ldexp(1.0, -52);
  CHECK(orientation({0, 0}, {1, 1}, {0.5, 0.5}) == 0);
  CHECK(orientation({0, 0}, {1, 1}, {0.5, 0.5 + tiny}) == 1);
  CHECK(orientation({12, 12}, {24, 24}, {0.5, 0.5 + tiny}) == 1);
  CHECK(orientation({12, 12}, {24, 24}, {0.5, 0.5}) == 0);
  const auto seed = GENERATE(range(1, 20));
  INFO("seed " << seed);
  Dice dice(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < 200; ++i) {
    // On a fine grid all products are integers below 2^53 and the sign is known.
    const auto at = [&] {
      return FlatPoint{std::ldexp(static_cast<double>(dice.below(1 << 20)), -30),
                       std::ldexp(static_cast<double>(dice.below(1 << 20)), -30)};
    };
    const FlatPoint a = at(), b = at(), c{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    CHECK(orientation(a, b, c) == 0);
    const FlatPoint d = at();
    CHECK(orientation(a, b, d) == -orientation(b, a, d));
    CHECK(orientation(a, b, d) == orientation(b, d, a));
  }
}

TEST_CASE("Boolean operations of squares have the areas that they must") {
  const FlatLoops a{square(0, 0, 4)}, b{square(1, 1, 2)}, c{square(3, 3, 4)};
  CHECK(area(combine(FlatOperation::kDifference, a, b)) == Approx(12));
  CHECK(area(combine(FlatOperation::kUnion, a, b)) == Approx(16));
  CHECK(area(combine(FlatOperation::kIntersection, a, c)) == Approx(1));
  CHECK(area(combine(FlatOperation::kUnion, a, c)) == Approx(31));
  CHECK(combine(FlatOperation::kDifference, b, a).empty());
}

TEST_CASE("an operand is even-odd: a loop within a loop is a hole, whichever way it turns") {
  FlatLoop hole = square(1, 1, 2);
  const FlatLoops one = resolved({square(0, 0, 4), hole});
  const FlatLoops other = resolved({square(0, 0, 4), {hole.rbegin(), hole.rend()}});
  CHECK(area(one) == Approx(12));
  CHECK(area(other) == Approx(12));
  REQUIRE(regions_of(one).size() == 1);
  CHECK(regions_of(one)[0].holes.size() == 1);
}

TEST_CASE("corners that stay keep their coordinates to the bit") {
  const FlatLoops a{{{0.1, 0.2}, {1e3 / 3, 0.3}, {7.7, 1e3 / 7}}};
  const FlatLoops result = resolved(a);
  REQUIRE(result.size() == 1);
  for (const FlatPoint& p : a[0])
    CHECK(std::find(result[0].begin(), result[0].end(), p) != result[0].end());
}

TEST_CASE("an offset grows a square by round, pointed and blunt corners") {
  const FlatLoops a{square(0, 0, 10)};
  const double pi = std::acos(-1.0);
  CHECK(area(offset(a, 1, FlatJoin::kMiter, 1)) == Approx(144));
  CHECK(area(offset(a, 1, FlatJoin::kRound, 1e-4)) == Approx(140 + pi).epsilon(1e-4));
  const double blunt = area(offset(a, 1, FlatJoin::kSquare, 1));
  CHECK((blunt > 140 + pi && blunt < 144));
  CHECK(area(offset(a, -2, FlatJoin::kMiter, 1)) == Approx(36));
  CHECK(offset(a, -6, FlatJoin::kMiter, 1).empty());
}

TEST_CASE("the hull of random points holds them all and turns left everywhere") {
  const auto seed = GENERATE(range(1, 30));
  INFO("seed " << seed);
  Dice dice(static_cast<std::uint64_t>(seed));
  std::vector<FlatPoint> points;
  for (int i = 0; i < 60; ++i) points.push_back({dice.on_grid(4), dice.on_grid(4)});
  const FlatLoop hull = flat_hull(points);
  REQUIRE(hull.size() >= 3);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const FlatPoint &a = hull[i], &b = hull[(i + 1) % hull.size()],
                    &c = hull[(i + 2) % hull.size()];
    CHECK(orientation(a, b, c) == 1);
    for (const FlatPoint& p : points) CHECK(orientation(a, b, p) >= 0);
  }
}

TEST_CASE("outlines that cross themselves too often are refused before they take memory") {
  const auto zigzag = [](int sides) {
    FlatLoop wild;
    for (int i = 0; i < sides; ++i)
      wild.push_back(
          {i % 2 == 0 ? 0.0 : 1.0, i * 0.618033988749895 - std::floor(i * 0.618033988749895)});
    return std::vector<FlatLoops>{{wild}};
  };
  CHECK(crossings_are_few(zigzag(200)));
  // These are few sides, but Clipper takes seconds for so many crossings.
  CHECK_FALSE(crossings_are_few(zigzag(600)));
  CHECK_FALSE(crossings_are_few(zigzag(6000)));
  CHECK(crossings_are_few(std::vector<FlatLoops>{{square(0, 0, 1)}, {square(0.5, 0, 1)}}));
}

}  // namespace
}  // namespace graycube
