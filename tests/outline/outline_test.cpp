// The pieces of an outline, and points in it.
#include "outline/outline.hpp"

#include <cmath>

#include "catch.hpp"
#include "outline/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("pieces join to the bit, and turn back neither in x nor in y") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const OutlineLoop loop = random_loops(dice).front();
    const auto pieces = pieces_of({loop});
    REQUIRE(pieces.size() >= loop.size() / 3);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const OutlinePiece &p = pieces[i], &next = pieces[(i + 1) % pieces.size()];
      CHECK(p.x.b[3] == next.x.b[0]);
      CHECK(p.y.b[3] == next.y.b[0]);
      for (const Cubic& c : {p.x, p.y}) {
        const double way = c.b[3] - c.b[0];
        double last = c.b[0];
        for (int k = 1; k <= 50; ++k) {
          const double here = c.at(k / 50.0);
          CHECK((way > 0 ? here - last : last - here) > -1e-13);
          last = here;
        }
      }
    }
  }
}

TEST_CASE("where control points coincide, a curve has the direction of its points nearby") {
  // From (0, 0) it sets out along x, though its other end lies at (1, 1), where it comes in along
  // y.
  const OutlinePiece twice_at_start{{{0, 0, 1, 1}}, {{0, 0, 0, 1}}};
  const OutlinePoint first = twice_at_start.tangent(0);
  CHECK(first.x > 0);
  CHECK(std::fabs(first.y) < 1e-4 * first.x);
  const OutlinePiece twice_at_end{{{0, 0, 1, 1}}, {{0, 1, 1, 1}}};
  const OutlinePoint last = twice_at_end.tangent(1);
  CHECK(last.x > 0);
  CHECK(std::fabs(last.y) < 1e-4 * last.x);
  // All points but one coincide, so that it is straight.
  const OutlinePoint straight = OutlinePiece{{{0, 0, 0, 2}}, {{0, 0, 0, 1}}}.tangent(0);
  CHECK(straight.x == 2 * straight.y);
  CHECK(straight.y > 0);
}

TEST_CASE("an outline holds the points that an odd number of its loops goes round") {
  std::size_t compared = 0, inside = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Dice dice(seed);
    const OutlineLoops loops = random_loops(dice);
    const Outline outline(loops);
    const Polygons polygons(loops);
    for (int i = 0; i < 100; ++i) {
      const double x = dice.between(-0.2, 1.2), y = dice.between(-1.2, 1.2);
      if (!polygons.is_clear(x, y, Polygons::kError)) continue;
      ++compared;
      inside += outline.contains({x, y}) ? 1 : 0;
      if (outline.contains({x, y}) != polygons.contains(x, y))
        FAIL("seed " << seed << ": " << x << ' ' << y);
      if (!outline.may_touch({{x - 2, y - 2}, {x + 2, y + 2}})) FAIL("touches nothing: " << seed);
    }
  }
  CHECK(compared > 10000);
  CHECK(inside > compared / 20);
}

TEST_CASE("a rectangle that an outline surely misses is told so, and one that it meets never") {
  std::size_t missed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Dice dice(seed);
    const Outline outline(random_loops(dice));
    for (int i = 0; i < 100; ++i) {
      const double size = std::pow(10, dice.between(-4, -1));
      const OutlinePoint lo{dice.between(0, 1), dice.between(-1, 1)};
      const OutlineBox box{lo, {lo.x + size, lo.y + size}};
      const bool touches = outline.may_touch(box);
      missed += touches ? 0 : 1;
      const auto& pieces = outline.pieces();
      const OutlinePoint p = pieces[dice.below(pieces.size())].at(dice.unit());
      if (!outline.may_touch({{p.x - size, p.y - size}, {p.x + size, p.y + size}}))
        FAIL("seed " << seed << ": " << p.x << ' ' << p.y);
    }
  }
  CHECK(missed > 15000);
}

TEST_CASE("copies of an outline are one, and outlines are equal by their loops") {
  const Outline a({rectangle({0, 0}, {1, 1})}), b({rectangle({0, 0}, {1, 1})});
  const Outline copy = a;
  CHECK(copy.is_same_as(a));
  CHECK(!b.is_same_as(a));
  CHECK(a == b);
  CHECK(!(a == Outline({rectangle({0, 0}, {1, 2})})));
  CHECK(Outline().pieces().empty());
  CHECK(!Outline().contains({0, 0}));
}
