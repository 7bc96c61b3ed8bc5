// Single primitives in cases where solvers go wrong: tangents, apexes, edges, thin shapes, great
// distances. Expected parameters are worked out by hand.
#include <cmath>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "csg/one_primitive.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

using Intervals = std::vector<std::pair<double, double>>;

Intervals intervals(const Spans& spans) {
  Intervals r;
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    r.emplace_back(s.enter, s.leave);
  }
  return r;
}

/// The inside part of the line, without (almost) empty intervals, and with touching ones joined.
Intervals solid_part(const Spans& spans, double tolerance) {
  Intervals r;
  for (const auto& [enter, leave] : intervals(spans)) {
    if (leave - enter < tolerance) continue;
    if (!r.empty() && enter - r.back().second < tolerance) {
      r.back().second = leave;
    } else {
      r.emplace_back(enter, leave);
    }
  }
  return r;
}

void check_part(const OnePrimitive& one, const Ray& ray, const Intervals& expected,
                double tolerance = 1e-12) {
  const Intervals found = solid_part(one.spans(ray), 1e-6);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(std::fabs(found[i].first - expected[i].first) <= tolerance);
    CHECK(std::fabs(found[i].second - expected[i].second) <= tolerance);
  }
}

const double kRoot2 = std::sqrt(2.0);

}  // namespace

TEST_CASE("a torus is crossed four times through its hole's plane") {
  const OnePrimitive one(node_of(TorusShape{{0, 0, 0}, {0, 0, 1}, 2, 0.5}));
  check_part(one, {{-5, 0, 0}, {1, 0, 0}}, {{2.5, 3.5}, {6.5, 7.5}});
  check_part(one, {{0, 0, 0}, {0, 1, 0}}, {{-2.5, -1.5}, {1.5, 2.5}});
  check_part(one, {{2, 0, 5}, {0, 0, -1}}, {{4.5, 5.5}});
  check_part(one, {{0, 0, 5}, {0, 0, -1}}, {});    // down the hole
  check_part(one, {{2.5, 0, 5}, {0, 0, -1}}, {});  // touches the outer equator
  check_part(one, {{3, 0, 0}, {0, 1, 0}}, {});
}

TEST_CASE("a ray that touches a torus from inside its hole stays inside on both sides") {
  // Counting roots by parity fails here.
  const OnePrimitive one(node_of(TorusShape{{0, 0, 0}, {0, 0, 1}, 2, 0.5}));
  check_part(one, {{1.5, -7, 0}, {0, 1, 0}}, {{5, 9}});
  // Along the top the line touches twice and is never inside.
  check_part(one, {{-5, 0, 0.5}, {1, 0, 0}}, {}, 1e-6);
  // Villarceau's line touches the tube from both sides of the hole: tilted by asin(minor / major).
  const double s = 0.25, c = std::sqrt(1 - s * s);
  const Ray touching{{0, 0, 0}, {c, 0, s}};
  for (const auto& [enter, leave] : intervals(one.spans(touching))) CHECK(leave - enter < 1e-6);
}

TEST_CASE("a torus far away keeps its digits") {
  const OnePrimitive one(node_of(TorusShape{{0, 0, 0}, {0, 0, 1}, 2, 0.5}));
  check_part(one, {{-1e5, 0, 0}, {1, 0, 0}}, {{1e5 - 2.5, 1e5 - 1.5}, {1e5 + 1.5, 1e5 + 2.5}},
             1e-10);
}

TEST_CASE("a cone is solved at its apex") {
  // Apex at the origin, base at z = 2 with radius 2: x² + y² ≤ z².
  const OnePrimitive one(node_of(ConeShape{{0, 0, 2}, 2, {0, 0, 0}, 0}));
  check_part(one, {{0, 0, -1}, {0, 0, 1}}, {{1, 3}});
  check_part(one, {{0, 0, 5}, {0, 0, -1}}, {{3, 5}});
  check_part(one, {{-3, 0, 0}, {1, 0, 0}}, {});  // touches the apex
  check_part(one, {{-3, 0, 1}, {1, 0, 0}}, {{2, 4}});
  const double s = std::sqrt(0.1), c = std::sqrt(0.9);  // steeper than the side, through the apex
  check_part(one, {{-s, 0, -c}, {s, 0, c}}, {{1, 1 + 2 / c}});
  check_part(one, {{-c, 0, -s}, {c, 0, s}}, {});  // flatter
  // Parallel to a generator, a's sign being lost: 1 below the side line.
  check_part(one, {{0, 0, 1}, {1 / kRoot2, 0, 1 / kRoot2}}, {{-0.5 * kRoot2, kRoot2}}, 1e-9);
}

TEST_CASE("a line that touches a cone is not inside it") {
  // Once the solver gave the whole line: at the foot of the axis' perpendicular the discriminant is
  // exactly 0.
  const OnePrimitive one(node_of(ConeShape{{0, 0, 0}, 1, {0, 0, 1}, 0}));
  check_part(one, {{1, -5, 0}, {0, 1, 0}}, {});
  check_part(one, {{0.5, -5, 0.5}, {0, 1, 0}}, {});
  check_part(one, {{0, -5, 1}, {0, 1, 0}}, {});
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const double h = 0.25 * static_cast<double>(dice.below(5)), from = dice.between(-9, 9);
    const double sign = dice.sign();
    for (const auto& [enter, leave] :
         intervals(one.spans({{sign * (1 - h), from, h}, {0, 1, 0}}))) {
      CHECK(std::fabs(enter + from) < 1e-7);
      CHECK(std::fabs(leave + from) < 1e-7);
    }
  }
}

TEST_CASE("a line that passes through a cone's apex far from its origin enters there") {
  // Once the parameter was left relative to the nearest point.
  const OnePrimitive one(node_of(ConeShape{{0, 0, 0}, 1, {0, 0, 1}, 0}));
  for (const double from : {3.0, 1000.0}) {
    check_part(one, {{0, 0, from}, {0, 0, -1}}, {{from - 1, from}});
    check_part(one, {{0, 0, -from}, {0, 0, 1}}, {{from, from + 1}});
  }
}

TEST_CASE("a ray in a face of a box is inside it, one beside it is not") {
  const OnePrimitive one(node_of(BoxShape{{-1, -1, -1}, {1, 1, 1}}));
  check_part(one, {{-3, 1, 0}, {1, 0, 0}}, {{2, 4}});
  check_part(one, {{-3, -1, 1}, {1, 0, 0}}, {{2, 4}});  // along an edge
  check_part(one, {{-3, std::nextafter(1.0, 2.0), 0}, {1, 0, 0}}, {});
  check_part(one, {{-2, 0, 0}, {1 / kRoot2, 1 / kRoot2, 0}}, {});  // touches an edge
}

TEST_CASE("a ray in a cap of a cylinder or along its side is inside it") {
  const OnePrimitive one(node_of(CylinderShape{{0, 0, 0}, {0, 2, 0}, 1}));
  check_part(one, {{-3, 2, 0}, {1, 0, 0}}, {{2, 4}});
  check_part(one, {{-3, 0, 0}, {1, 0, 0}}, {{2, 4}});
  check_part(one, {{1, -3, 0}, {0, 1, 0}}, {{3, 5}});
  check_part(one, {{0, -3, 1}, {0, 1, 0}}, {{3, 5}});
  check_part(one, {{1.0000001, -3, 0}, {0, 1, 0}}, {});
  check_part(one, {{-3, 1, 1}, {1, 0, 0}}, {});  // touches the side
}

TEST_CASE("thin shapes keep both their faces") {
  const OnePrimitive disc(node_of(CylinderShape{{0, 0, 0}, {0, 1e-6, 0}, 5}));
  const auto through_disc = intervals(disc.spans({{0, 100, 0}, {0, -1, 0}}));
  REQUIRE(through_disc.size() == 1);
  CHECK(through_disc[0].first == Approx(100 - 1e-6).epsilon(1e-15));
  CHECK(through_disc[0].second == 100);

  const OnePrimitive sheet(node_of(BoxShape{{-1, -1, 0}, {1, 1, 1e-12}}));
  const auto through_sheet = intervals(sheet.spans({{0, 0, -1}, {0, 0, 1}}));
  REQUIRE(through_sheet.size() == 1);
  CHECK(through_sheet[0].first == 1);
  CHECK(through_sheet[0].second > 1);

  const OnePrimitive needle(
      node_of(EllipsoidShape{{0, 0, 0}, {Vec3{1e-5, 0, 0}, {0, 3, 0}, {0, 0, 1e-5}}}));
  const auto across = intervals(needle.spans({{-10, 1, 0}, {1, 0, 0}}));
  REQUIRE(across.size() == 1);
  const double half = 1e-5 * std::sqrt(1 - 1.0 / 9);
  CHECK(std::fabs(across[0].first - (10 - half)) < 1e-12);
  CHECK(std::fabs(across[0].second - (10 + half)) < 1e-12);
}

TEST_CASE("a small sphere far away keeps its digits") {
  const OnePrimitive one(node_of(SphereShape{{0, 0, 1e6}, 1e-3}));
  const auto through = intervals(one.spans({{0, 0, 0}, {0, 0, 1}}));
  REQUIRE(through.size() == 1);
  CHECK(std::fabs(through[0].first - (1e6 - 1e-3)) < 1e-9);
  CHECK(std::fabs(through[0].second - (1e6 + 1e-3)) < 1e-9);
  // Off the centre by half the radius.
  const auto beside = intervals(one.spans({{5e-4, 0, 0}, {0, 0, 1}}));
  REQUIRE(beside.size() == 1);
  CHECK(std::fabs(beside[0].first - (1e6 - 1e-3 * std::sqrt(0.75))) < 1e-9);
}

TEST_CASE("an unbounded half-space ends where its plane is") {
  const OnePrimitive one(node_of(HalfSpaceShape{{0, 2, 0}, 3}));  // y ≤ 1.5, the normal not unit
  CHECK(intervals(one.spans({{0, 5, 0}, {0, -1, 0}})) == Intervals{{3.5, kInf}});
  CHECK(intervals(one.spans({{0, 5, 0}, {0, 1, 0}})) == Intervals{{-kInf, -3.5}});
  CHECK(intervals(one.spans({{0, 1.5, 0}, {1, 0, 0}})) == Intervals{{-kInf, kInf}});
  CHECK(intervals(one.spans({{0, 1.6, 0}, {1, 0, 0}})).empty());
}

TEST_CASE("a polyhedron's bounds hold what is unbounded") {
  // Once a polyhedron of one effective plane was bounded by that plane's own, flat bounds.
  const OnePrimitive half(node_of(PolyhedronShape{{{{0, 1, 0}, 1}, {{0, 1, 0}, 2}}}));
  CHECK(half.bounds() == Aabb{{-kInf, -kInf, -kInf}, {kInf, 1, kInf}});
  // And a corner open to a slanted direction ended where its clipped faces did.
  const OnePrimitive corner(node_of(PolyhedronShape{{{{0.548, -0.018, -0.836}, -0.329},
                                                     {{-0.756, -0.361, -0.545}, -3.182},
                                                     {{0.580, 0.305, 0.755}, -1.424}}}));
  for (double far = 100; far < 1e9; far *= 10) {
    const Vec3 p = far * Vec3{-1.27, 3.97, -0.72};
    CHECK(corner.holds(p));
    CHECK(corner.bounds().contains(p));
  }
  const OnePrimitive cube(node_of(PolyhedronShape{{{{1, 0, 0}, 1},
                                                   {{-1, 0, 0}, 1},
                                                   {{0, 1, 0}, 1},
                                                   {{0, -1, 0}, 1},
                                                   {{0, 0, 1}, 1},
                                                   {{0, 0, -1}, 1}}}));
  CHECK(cube.bounds().grown(-1e-6).contains({0.99, 0.99, 0.99}));
  CHECK_FALSE(cube.bounds().contains({1.001, 0, 0}));
}

TEST_CASE("normals of caps and faces are exact") {
  const OnePrimitive cylinder(node_of(CylinderShape{{0, -1, 0}, {0, 1, 0}, 1}));
  CHECK(cylinder.normal({{0, 5, 0}, {0, -1, 0}}, 4) == Vec3{0, 1, 0});
  CHECK(cylinder.normal({{0, 5, 0}, {0, -1, 0}}, 6) == Vec3{0, -1, 0});
  CHECK(cylinder.normal({{-5, 0, 0}, {1, 0, 0}}, 4) == Vec3{-1, 0, 0});
  const Affine mirror = scaling({1, -2, 1});
  const OnePrimitive mirrored(transformed(node_of(ConeShape{{0, 0, 0}, 1, {0, 1, 0}, 0}), mirror));
  CHECK(mirrored.normal({{0.1, 5, 0}, {0, -1, 0}}, 5) == Vec3{0, 1, 0});
  const OnePrimitive box(transformed(node_of(BoxShape{{-1, -1, -1}, {1, 1, 1}}), mirror));
  CHECK(box.normal({{0, 5, 0}, {0, -1, 0}}, 3) == Vec3{0, 1, 0});
  CHECK(box.normal({{0, 5, 0}, {0, -1, 0}}, 7) == Vec3{0, -1, 0});
}

TEST_CASE(
    "a torus whose tube is thicker than its ring is solid throughout, with a dent at each end") {
  // An elliptic torus that is round; through the axis its surface goes at heights ±4.
  const OnePrimitive one(node_of(EllipticTorusShape{{0, 0, 0}, {0, 0, 1}, 3, 5, 0, 5}));
  check_part(one, {{0, 0, -10}, {0, 0, 1}}, {{6, 14}}, 1e-6);
  check_part(one, {{-10, 0, 0}, {1, 0, 0}}, {{2, 18}});
  // Over the middle the line is in the rim, then in the dent, then in the rim again.
  const double rim = std::sqrt(25 - 4.5 * 4.5);
  check_part(one, {{-10, 0, 4.5}, {1, 0, 0}}, {{7 - rim, 7 + rim}, {13 - rim, 13 + rim}}, 1e-9);
  CHECK(one.holds({0, 0, 0}));
  CHECK(one.holds({0, 0, 3.9}));
  CHECK_FALSE(one.holds({0, 0, 4.1}));
  const Vec3 n = one.normal({{0.5, 0, 10}, {0, 0, -1}}, 10 - std::sqrt(25 - 2.5 * 2.5));
  CHECK(n.z > 0);
  CHECK(n.x < 0);
}
