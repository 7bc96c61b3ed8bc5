// offset() and other flat shapes with exact arcs, as OpenSCAD means them.

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/within.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

TEST_CASE("flat shapes grow by exact arcs") {
  const auto flat = [](double low, double high, const Distance& d) {
    return [=](const Vec3& p) { return p.z < low || p.z > high ? 100 : d(p); };
  };
  const std::string extrude = "linear_extrude(height = 3) ";
  check_within(extrude + "offset(r = 1.5) " + kAngle + ";", flat(0, 3, from_flat_angle), 1.5);
  check_within(extrude + "minkowski() { circle(r = 1.5); " + kAngle + "; }",
               flat(0, 3, from_flat_angle), 1.5);
  check_within(extrude + "offset(r = 1) offset(r = 0.5) " + kAngle + ";",
               flat(0, 3, from_flat_angle), 1.5);
  check_within(extrude + "offset(r = 1.5) square(size = [6, 4]);",
               flat(0, 3,
                    [](const Vec3& p) {
                      return from_box({p.x, p.y, 0}, {}, {6, 4, 0});
                    }),
               1.5);
  check_within(extrude + "offset(delta = 1.5) circle(r = 2);",
               flat(0, 3, [](const Vec3& p) { return std::max(0.0, std::hypot(p.x, p.y) - 2); }),
               1.5);
}

TEST_CASE("flat shapes shrink by exact arcs") {
  // All points remain whose distance from the outside is more than 1: the outside begins at the
  // angle's boundary.
  const Scene scene = scene_of("linear_extrude(height = 3) offset(r = -1) " + kAngle + ";");
  for (const auto& [p, inside] : {std::pair{Vec3{1.01, 1.01, 1}, true},
                                  {Vec3{0.99, 2, 1}, false},
                                  {Vec3{8.99, 1.99, 1}, true},
                                  {Vec3{9.01, 1.5, 1}, false},
                                  {Vec3{2.28, 2.28, 1}, true},
                                  {Vec3{2.3, 2.3, 1}, false},
                                  {Vec3{1.9, 2.9, 1}, true}}) {
    INFO(p.x << " " << p.y);
    CHECK(any_object_holds(scene, p) == inside);
  }
}

TEST_CASE("an offset in and out again rounds the corners that point outwards") {
  const auto core = [](const Vec3& p) {
    if (p.z < 0 || p.z > 3) return 100.0;
    return from_box({p.x, p.y, 0}, {2, 2, 0}, {8, 6, 0});
  };
  check_within("linear_extrude(height = 3) offset(r = 2) offset(r = -2) square(size = [10, 8]);",
               core, 2);
  check_within(
      "linear_extrude(height = 3) offset(r = 2) offset(delta = -2) square(size = [10, 8]);", core,
      2);
}

/// The angle with some of its corners rounded by the radius, between z = 0 and 3.
bool in_rounded_angle(const Vec3& p, double radius, bool rounds_outer, bool fills_inner) {
  if (p.z < 0 || p.z > 3) return false;
  const auto beyond_arc = [&](double x, double y, int towards_x, int towards_y) {
    // The square between the corner and the arc's centre, without the disk.
    const double dx = towards_x * (p.x - x), dy = towards_y * (p.y - y);
    return dx >= 0 && dx <= radius && dy >= 0 && dy <= radius &&
           std::hypot(dx - radius, dy - radius) > radius;
  };
  if (fills_inner && beyond_arc(3, 3, 1, 1)) return true;
  if (from_flat_angle(p) > 0) return false;
  if (!rounds_outer) return true;
  return !beyond_arc(0, 0, 1, 1) && !beyond_arc(10, 0, -1, 1) && !beyond_arc(10, 3, -1, -1) &&
         !beyond_arc(3, 10, -1, -1) && !beyond_arc(0, 10, 1, -1);
}

void check_rounded(const std::string& offsets, double radius, bool rounds_outer, bool fills_inner) {
  const std::string text = "linear_extrude(height = 3) " + offsets + " " + kAngle + ";";
  INFO(text);
  CHECK(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  std::mt19937_64 random(18);
  std::uniform_real_distribution<double> place(-1, 11);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{place(random), place(random), 1};
    wrong += any_object_holds(scene, p) == in_rounded_angle(p, radius, rounds_outer, fills_inner)
                 ? 0
                 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("offsets in and out round the corners that point outwards, out and in fill the others") {
  check_rounded("offset(r = 1.2) offset(r = -1.2)", 1.2, true, false);
  check_rounded("offset(r = -1.2) offset(r = 1.2)", 1.2, false, true);
  check_rounded("offset(r = -1.2) offset(r = 2.4) offset(r = -1.2)", 1.2, true, true);
  check_rounded("offset(r = 1.2) offset(delta = -1.2)", 1.2, true, false);
  check_rounded("offset(delta = -1.2) offset(r = 1.2)", 0, false, false);
  check_rounded("offset(r = -1.5) offset(r = 0.5) offset(delta = 1)", 1.5, false, true);
}

TEST_CASE("holes shrink when a plate grows, and parts that are apart shrink each for itself") {
  const auto extruded = [](const Distance& d) {
    return [=](const Vec3& p) { return p.z < 0 || p.z > 3 ? 100 : d(p); };
  };
  const std::string hole = "multmatrix([[1, 0, 0, 5], [0, 1, 0, 4]]) circle(r = 3);";
  check_within(
      "linear_extrude(height = 3) offset(r = 1.5) difference() { square(size = [10, 8]); " + hole +
          " }",
      extruded([](const Vec3& p) {
        return std::max(from_box({p.x, p.y, 0}, {}, {10, 8, 0}), 3 - std::hypot(p.x - 5, p.y - 4));
      }),
      1.5);
  check_within(
      "linear_extrude(height = 3) offset(r = -1.5) { square(size = [6, 5]); multmatrix([[1, 0, 0, "
      "11], [0, 1, 0, 9]]) "
      "circle(r = 3); }",
      extruded([](const Vec3& p) {
        return std::min(from_box({p.x, p.y, 0}, {1.5, 1.5, 0}, {4.5, 3.5, 0}),
                        std::max(0.0, std::hypot(p.x - 11, p.y - 9) - 1.5));
      }),
      kItself);
  CHECK(warnings_of(
            "linear_extrude(height = 3) offset(r = -1) { square(size = [6, 5]); circle(r = 3); }")
            .size() == 1);
}

TEST_CASE("what has no sharp corner grows alike by both kinds of offset") {
  const std::string slot = "hull() { circle(r = 2); " + kMoved + "circle(r = 1); }";
  const auto objects = [&](const std::string& offset) {
    return scene_of("linear_extrude(height = 3) " + offset + slot).objects;
  };
  CHECK(objects("offset(delta = 1.5) ") == objects("offset(r = 1.5) "));
  CHECK(objects("offset(delta = 1) ") != objects("offset(r = 1.5) "));
}

TEST_CASE("holes count neither in a hull nor in the way of sharp corners") {
  const std::string plate =
      "difference() { square(size = [10, 8]); multmatrix([[1, 0, 0, 5], [0, 1, 0, 4]]) circle(r = "
      "2); }";
  const Scene hull = scene_of("linear_extrude(height = 3) hull() { circle(r = 1); " + plate + " }");
  CHECK((any_object_holds(hull, {5, 4, 1}) && any_object_holds(hull, {-0.99, 0, 1}) &&
         !any_object_holds(hull, {-0.9, -0.9, 1})));
  const std::string text = "linear_extrude(height = 3) offset(delta = 1) " + plate;
  CHECK(warnings_of(text).empty());
  const Scene grown = scene_of(text);
  CHECK((any_object_holds(grown, {-0.99, -0.99, 1}) && any_object_holds(grown, {6.01, 4, 1}) &&
         !any_object_holds(grown, {5.7, 4.7, 1}) && any_object_holds(grown, {5.71, 4.71, 1})));
}

TEST_CASE("any polygon and a convex figure add up") {
  const auto grown = [](double low, double high, double margin_x, double margin_y) {
    return [=](const Vec3& p) {
      if (p.z < low || p.z > high) return 100.0;
      const auto from = [&](double x, double y) {
        return from_box({p.x, p.y, 0}, {-margin_x, -margin_y, 0}, {x + margin_x, y + margin_y, 0});
      };
      return std::min(from(10, 3), from(3, 10));
    };
  };
  const std::string flat = "linear_extrude(height = 5) minkowski() { " + kAngle + "; ";
  check_within(flat + "square(size = [2, 1], center = true); }", grown(0, 5, 1, 0.5), kItself);
  check_within(
      flat + "hull() { circle(r = 1); multmatrix([[1, 0, 0, 2], [0, 1, 0, 0]]) circle(r = 1); } }",
      [](const Vec3& p) {
        if (p.z < 0 || p.z > 5) return 100.0;
        return std::min(from_box({p.x, p.y, 0}, {}, {12, 3, 0}),
                        from_box({p.x, p.y, 0}, {}, {5, 10, 0}));
      },
      1);
  check_within(
      "minkowski() { linear_extrude(height = 5) " + kAngle + "; cube(size = 1, center = true); }",
      grown(-0.5, 5.5, 0.5, 0.5), kItself);
}

TEST_CASE("a slit that an offset closes stays closed") {
  // Two arms 1 apart: grown by 1 they are one, so that 1 back leaves the slit filled.
  const std::string text =
      "linear_extrude(height = 3) offset(r = -1) offset(r = 1) polygon(points = [[0, 0], [10, 0], "
      "[10, 4], "
      "[0, 4], [0, 2.5], [8, 2.5], [8, 1.5], [0, 1.5]]);";
  CHECK_FALSE(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  CHECK((any_object_holds(scene, {4, 2, 1}) && any_object_holds(scene, {1, 2, 1}) &&
         !any_object_holds(scene, {-0.5, 2, 1})));
  // The slit is only just narrow enough here.
  CHECK_FALSE(warnings_of("linear_extrude(height = 3) offset(r = -1) offset(r = 1) polygon(points "
                          "= [[0, 0], [10, 0], [10, 4], "
                          "[0, 4], [0, 2.999], [8, 2.999], [8, 1], [0, 1]]);")
                  .empty());
}

}  // namespace
}  // namespace graycube
