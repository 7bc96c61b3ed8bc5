// Rays that lie in a surface, touch it, go along the axis or through joints, on shapes for which
// the right intervals are known.
#include <cmath>

#include "catch.hpp"
#include "outline/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A tube of radii 0.5 and 1 from z = −1 to 1.
Placed tube() { return Placed({rectangle({0.5, -1}, {1, 1})}); }
/// A solid cylinder of radius 1.
Placed rod() { return Placed({rectangle({0, -1}, {1, 1})}); }

Spans turned(const Placed& placed, const Vec3& origin, const Vec3& direction) {
  return csg::lathe_spans(placed.place(), {origin, direction});
}
Spans swept(const Placed& placed, const Vec3& origin, const Vec3& direction) {
  return csg::sweep_spans(placed.place(), {origin, direction});
}

void check(const Spans& spans, std::initializer_list<Spans::Interval> right) {
  REQUIRE(spans.count == static_cast<int>(right.size()));
  std::size_t i = 0;
  for (const auto& r : right) {
    CHECK(spans.interval[i].enter == Approx(r.enter).margin(1e-14));
    CHECK(spans.interval[i].leave == Approx(r.leave).margin(1e-14));
    ++i;
  }
}

}  // namespace

TEST_CASE("a level ray crosses both walls of a tube twice") {
  check(turned(tube(), {-3, 0, 0.25}, {1, 0, 0}), {{2, 2.5}, {3.5, 4}});
  check(turned(tube(), {0, 0, 0.25}, {1, 0, 0}), {{-1, -0.5}, {0.5, 1}});
}

TEST_CASE("a nearly level ray crosses what a level one crosses") {
  for (double tilt = 1e-1; tilt > 1e-300; tilt *= 1e-3) {
    INFO("tilt " << tilt);
    const Vec3 d = normalized({1, 0, 0.1 * tilt});
    const Spans spans = turned(tube(), {-3, 0, 0.25}, d);
    check(spans, {{2 / d.x, 2.5 / d.x}, {3.5 / d.x, 4 / d.x}});
    const Spans down = turned(tube(), {-3, 0, 0.25}, {d.x, d.y, -d.z});
    check(down, {{2 / d.x, 2.5 / d.x}, {3.5 / d.x, 4 / d.x}});
  }
}

TEST_CASE("a ray along the axis passes through a rod and misses a tube") {
  check(turned(rod(), {0, 0, -4}, {0, 0, 1}), {{3, 5}});
  check(turned(rod(), {0, 0, 4}, {0, 0, -1}), {{3, 5}});
  check(turned(tube(), {0, 0, -4}, {0, 0, 1}), {});
}

TEST_CASE("a nearly upright ray crosses what an upright one crosses") {
  for (double tilt = 1e-3; tilt > 1e-300; tilt *= 1e-3) {
    INFO("tilt " << tilt);
    check(turned(tube(), {0.75, 0, -4}, {1e-3 * tilt, 0, 1}), {{3, 5}});
    check(swept(rod(), {0.5, 0.25, -4}, {1e-3 * tilt, tilt * 1e-3, 1}), {{3.5, 4.5}});
  }
  check(turned(tube(), {0.75, 0, -4}, {0, 0, 1}), {{3, 5}});
  check(swept(rod(), {0.5, 0.25, -4}, {0, 0, 1}), {{3.5, 4.5}});
  check(swept(rod(), {1.5, 0.25, -4}, {0, 0, 1}), {});
}

TEST_CASE("a ray within a wall or an end has whole intervals there, or none") {
  for (const Vec3& origin : {Vec3{1, 0, -4}, Vec3{0.5, 0, -4}, Vec3{0, 1, -4}}) {
    const Spans spans = turned(tube(), origin, {0, 0, 1});
    CHECK(spans.count <= 1);
    if (spans.count == 1) check(spans, {{3, 5}});
  }
  for (const double height : {-1.0, 1.0}) {
    const Spans spans = turned(tube(), {-3, 0, height}, {1, 0, 0});
    if (spans.count > 0) check(spans, {{2, 2.5}, {3.5, 4}});
  }
  // The ends of a sweep belong to it, as those of a cylinder do.
  for (const double height : {-0.5, 0.5})
    check(swept(rod(), {-3, 0.25, height}, {1, 0, 0}), {{3, 4}});
}

TEST_CASE(
    "a ray past a wall that it only touches is outside, or inside for no more than rounding") {
  for (const double by : {-1e-15, 0.0, 1e-15}) {
    const Spans spans = turned(rod(), {-3, 1 + by, 0.25}, {1, 0, 0});
    CHECK(spans.count <= 1);
    if (spans.count == 1) CHECK(spans.interval[0].leave - spans.interval[0].enter < 1e-6);
  }
}

TEST_CASE("rays through the apex of a cone leave and enter there") {
  OutlineLoop loop;
  add_straight(loop, {0, 0}, {1, 1});
  add_straight(loop, {1, 1}, {0, 1});
  add_straight(loop, {0, 1}, {0, 0});
  const Placed cone({loop});
  check(turned(cone, {0, 0, -1}, {0, 0, 1}), {{1, 2}});
  check(turned(cone, {-1, 0, 0.5}, {1, 0, 0}), {{0.5, 1.5}});
  const Vec3 d = normalized({1, 0, 3});
  check(turned(cone, -2.0 * d, d), {{2, 2 + 1 / d.z}});
}

TEST_CASE("loops in loops are holes, and cost no parity where they touch") {
  const Placed two({rectangle({0.25, -1}, {1, 1}), rectangle({0.5, -0.5}, {0.75, 0.5})});
  check(turned(two, {-3, 0, 0}, {1, 0, 0}), {{2, 2.25}, {2.5, 2.75}, {3.25, 3.5}, {3.75, 4}});
  const Placed touching({rectangle({0.25, -1}, {0.5, 1}), rectangle({0.5, -1}, {1, 1})});
  check(turned(touching, {-3, 0, 0.125}, {1, 0, 0}), {{2, 2.75}, {3.25, 4}});
}

TEST_CASE("normals of a lathe are perpendicular to the outline") {
  const Ray side{{-3, 0, 0.25}, {1, 0, 0}};
  CHECK(length(csg::lathe_normal(tube().place(), side, 2) - Vec3{-1, 0, 0}) < 1e-14);
  const Ray above{{0.75, 0, 4}, {0, 0, -1}};
  CHECK(length(csg::lathe_normal(tube().place(), above, 3) - Vec3{0, 0, 1}) < 1e-14);
  CHECK(length(csg::lathe_normal(tube().place(), above, 5) - Vec3{0, 0, -1}) < 1e-14);
}

TEST_CASE("an outline of thousands of segments looks at few of them for a ray") {
  OutlineLoop loop;
  const int segments = 4000;
  for (int i = 0; i < segments; ++i) {
    const double a = 8.0 * i / segments, b = 8.0 * (i + 1) / segments;
    // Once around a square with waves on it.
    const auto point = [](double s) {
      const double along = s < 2 ? s - 1 : s < 4 ? 1 : s < 6 ? 5 - s : -1;
      const double up = s < 2 ? -1 : s < 4 ? s - 3 : s < 6 ? 1 : 7 - s;
      return OutlinePoint{2 + along, up};
    };
    add_straight(loop, point(a), point(b));
  }
  const Outline outline({loop});
  std::size_t looked_at = 0, visited = 0;
  const auto meets = [&](const OutlineBox& box) {
    ++looked_at;
    return box.lo.y <= 0.123 && box.hi.y >= 0.123;
  };
  outline.each_piece(meets, [&](const OutlinePiece&) { ++visited; });
  CHECK(visited >= 2);
  CHECK(looked_at < 200);
}
