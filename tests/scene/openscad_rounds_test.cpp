// hull(), minkowski() and offset() of what is round, as OpenSCAD means them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "scene/openscad.hpp"
#include "scene/openscad/reading.hpp"
#include "scene/scene_membership.hpp"
#include "scene/write_scene.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

/// The distance of a point from a solid, 0 inside.
using Distance = std::function<double(const Vec3&)>;

double from_box(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  Vec3 d;
  for (int a = 0; a < 3; ++a) d[a] = std::max({lo[a] - p[a], 0.0, p[a] - hi[a]});
  return length(d);
}

/// For a solid that is the scene itself: more than the rounding that is allowed.
constexpr double kItself = 2e-9;

/// The scene must be everything within `radius` of the solid.
void check_within(const std::string& text, const Distance& distance, double radius) {
  INFO(text);
  CHECK(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  constexpr std::uint64_t kSeed = 17;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-4, 16);
  int wrong = 0, inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{place(random), place(random), place(random)};
    const double d = distance(p) - radius;
    if (std::fabs(d) < 1e-9) continue;
    inside += d < 0 ? 1 : 0;
    wrong += any_object_holds(scene, p) == (d < 0) ? 0 : 1;
  }
  INFO("seed " << kSeed);
  CHECK(wrong == 0);
  CHECK(inside > 100);
}

const std::string kMoved = "multmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) ";
const std::string kAngle = "polygon(points = [[0, 0], [10, 0], [10, 3], [3, 3], [3, 10], [0, 10]])";

double from_angle(const Vec3& p) {
  return std::min(from_box(p, {0, 0, 0}, {10, 3, 5}), from_box(p, {0, 0, 0}, {3, 10, 5}));
}
double from_flat_angle(const Vec3& p) { return from_angle({p.x, p.y, 1}); }

TEST_CASE("a solid and a ball give all that is within its radius") {
  check_within(
      "minkowski() { cube(size = [8, 6, 4]); sphere(r = 1.5); }",
      [](const Vec3& p) {
        return from_box(p, {0, 0, 0}, {8, 6, 4});
      },
      1.5);
  check_within(
      "minkowski() { sphere(r = 1.5); union() { cube(size = [8, 2, 2]); cube(size = [2, 8, 2]); } "
      "}",
      [](const Vec3& p) {
        return std::min(from_box(p, {}, {8, 2, 2}), from_box(p, {}, {2, 8, 2}));
      },
      1.5);
  check_within("minkowski() { linear_extrude(height = 5) " + kAngle + "; sphere(r = 1.25); }",
               from_angle, 1.25);
  check_within(
      "minkowski() { sphere(r = 1); cube(size = [3, 4, 5]); cube(size = [5, 2, 1]); sphere(r = "
      "0.5); }",
      [](const Vec3& p) {
        return from_box(p, {}, {8, 6, 6});
      },
      1.5);
}

TEST_CASE("a cylinder and a ball give a cylinder with round rims") {
  check_within(
      "minkowski() { cylinder(h = 6, r1 = 3, r2 = 3); sphere(r = 1); }",
      [](const Vec3& p) {
        const double out = std::max(0.0, std::hypot(p.x, p.y) - 3),
                     up = std::max({-p.z, 0.0, p.z - 6});
        return std::hypot(out, up);
      },
      1);
}

TEST_CASE("a prism and an upright cylinder give the prism with round corners, as high as both") {
  const auto both = [](const Vec3& p) { return p.z < 0 || p.z > 7 ? 100 : from_flat_angle(p); };
  check_within("minkowski() { linear_extrude(height = 5) " + kAngle +
                   "; cylinder(h = 2, r1 = 1.5, r2 = 1.5); }",
               both, 1.5);
  const auto box = [](const Vec3& p) {
    return p.z < 0 || p.z > 5 ? 100 : from_box({p.x, p.y, 1}, {}, {8, 6, 4});
  };
  check_within("minkowski() { cube(size = [8, 6, 4]); cylinder(h = 1, r1 = 1.5, r2 = 1.5); }", box,
               1.5);
}

TEST_CASE("two boxes give a box") {
  const Scene scene =
      scene_of("minkowski() { cube(size = [1, 2, 3]); cube(size = 4, center = true); }");
  REQUIRE(scene.objects.size() == 1);
  for (const auto& [p, inside] : {std::pair{Vec3{-1.9, -1.9, -1.9}, true},
                                  {Vec3{2.9, 3.9, 4.9}, true},
                                  {Vec3{3.1, 0, 0}, false},
                                  {Vec3{0, 0, -2.1}, false}}) {
    CHECK(any_object_holds(scene, p) == inside);
  }
}

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
  // What is left is all whose distance from the outside is more than 1: the outside is what is near
  // the angle's boundary.
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
    // The square between the corner and the arc's centre, but for the disk.
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
  // Just so.
  CHECK_FALSE(warnings_of("linear_extrude(height = 3) offset(r = -1) offset(r = 1) polygon(points "
                          "= [[0, 0], [10, 0], [10, 4], "
                          "[0, 4], [0, 2.999], [8, 2.999], [8, 1], [0, 1]]);")
                  .empty());
}

TEST_CASE("a hull whose ends are cylinders has the very cylinders") {
  const std::string post = "cylinder(h = 4, r1 = 2.7, r2 = 2.7);";
  const Scene scene = scene_of("hull() { " + post + kMoved + post + " }");
  const auto& pieces = std::get<OperationNode>(scene.objects[0].csg.value).children;
  REQUIRE(pieces.size() == 3);
  CHECK(std::get<BoxShape>(pieces[0].value) == BoxShape{{0, -2.7, 0}, {8, 2.7, 4}});
  CHECK(std::get<CylinderShape>(pieces[1].value) == CylinderShape{{0, 0, 0}, {0, 0, 4}, 2.7});
  CHECK(std::get<CylinderShape>(pieces[2].value) == CylinderShape{{8, 0, 0}, {8, 0, 4}, 2.7});
}

TEST_CASE("turned cylinders are hulled in their own frame") {
  const std::string turned =
      "multmatrix([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]) ";
  const std::string post = "cylinder(h = 4, r1 = 2, r2 = 2);";
  const Scene inside = scene_of("hull() { " + turned + post + kMoved + turned + post + " }");
  const Scene outside = scene_of(turned + "hull() { " + post + kMoved + post + " }");
  CHECK(inside.objects == outside.objects);
}

TEST_CASE("the hull of a ball and a cylinder on one axis is turned about it") {
  const std::string up = "multmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 8], [0, 0, 0, 1]]) ";
  const std::string text = "hull() { " + up +
                           "sphere(r = 1); multmatrix([[1, 0, 0, 1], [0, 1, 0, 2]]) "
                           "cylinder(h = 2, r1 = 3, r2 = 3); }";
  CHECK(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  const auto in = [&](double out, double z) { return any_object_holds(scene, {1 + out, 2, z}); };
  // The side touches the ball and the upper rim: distance 1 from (0, 8), through (3, 2).
  CHECK((in(0, 8.99) && !in(0, 9.01) && in(2.99, 1) && !in(3.01, 1) && in(0.99, 8) && in(1, 6.8) &&
         !in(2.2, 6.8)));
}

TEST_CASE("columns that are round below and flat on top have a flat top and vertical sides") {
  std::string text = "hull() {";
  for (const char* at : {"0, 0, 0", "0, 6, 0", "8, 0, 0", "8, 6, 0"}) {
    const std::string x(1, at[0]), y(1, at[3]);
    text += " multmatrix([[1, 0, 0, " + x + "], [0, 1, 0, " + y +
            "]]) { sphere(r = 1.5); cylinder(h = 5, r1 = 1.5, r2 = 1.5); }";
  }
  const auto distance = [](const Vec3& p) {
    return p.z > 5 ? 100 : from_box(p, {0, 0, 0}, {8, 6, 5});
  };
  check_within(text + " }", distance, 1.5);
  const Scene scene = scene_of(text + " }");
  CHECK(std::get<BoxShape>(std::get<OperationNode>(scene.objects[0].csg.value).children[1].value)
            .max.z == 5);
}

TEST_CASE("a cap that something sticks out of sideways has no exact form") {
  const std::string text =
      "hull() { sphere(r = 3); cylinder(h = 5, r1 = 1, r2 = 1); " + kMoved + "sphere(r = 1); }";
  CHECK(warnings_of(text).size() == 1);
}

TEST_CASE("a box, a cylinder and a ball give a plate with round corners and rims") {
  const auto rounded = [](const Vec3& p) {
    const double out = std::max(0.0, from_box({p.x, p.y, 1}, {}, {8, 6, 4}) - 2),
                 up = std::max({-p.z, 0.0, p.z - 5});
    return std::hypot(out, up);
  };
  check_within(
      "minkowski() { cube(size = [8, 6, 4]); cylinder(h = 1, r1 = 2, r2 = 2); sphere(r = 1); }",
      rounded, 1);
}

TEST_CASE("numbers beyond reason end in no scene that can't be written") {
  for (const char* size : {"1e-300", "1e-160", "1e-31", "1e29", "1e160", "1e300"}) {
    const std::string r(size);
    for (const std::string& text :
         {"hull() { sphere(r = " + r + "); " + kMoved + "sphere(r = 1); cube(size = " + r + "); }",
          "minkowski() { cube(size = 2); cylinder(h = 1, r1 = " + r + ", r2 = 1); }",
          "minkowski() { cube(size = [1, 2, " + r + "]); sphere(r = 1); }",
          "linear_extrude(height = 1) offset(r = " + r + ") " + kAngle + ";",
          "linear_extrude(height = 1) offset(r = -1) offset(r = 2) square(size = [1, " + r + "]);",
          "linear_extrude(height = 1) hull() { circle(r = " + r + "); " + kMoved +
              "circle(r = 1); }"}) {
      INFO(text);
      const OpenscadResult result = read_openscad_csg(text);
      if (!result.scene) continue;
      const std::string written = write_scene_text(*result.scene);
      CHECK(written.find("nan") == std::string::npos);
    }
  }
}

TEST_CASE("circles in a hull under one uneven scale stay exact") {
  const std::string text =
      "linear_extrude(height = 1) multmatrix([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0]]) hull() { "
      "circle(r = 2); " +
      kMoved + "circle(r = 1); }";
  CHECK(warnings_of(text).empty());
  const Scene scene = scene_of(text);
  CHECK((any_object_holds(scene, {0, 3.999, 0.5}) && !any_object_holds(scene, {0, 4.1, 0.5}) &&
         any_object_holds(scene, {8.999, 0, 0.5})));
}

TEST_CASE(
    "what has no exact form is said to have OpenSCAD's sides, and few sides or facets asked for "
    "are kept") {
  const std::string mixed =
      "hull() { sphere(r = 1); " + kMoved + "cylinder(h = 2, r1 = 1, r2 = 1); }";
  CHECK(warnings_of(mixed) ==
        std::vector<std::string>{"line 1: hull() takes what is round by OpenSCAD's sides; "
                                 "what is round around it is exact"});
  const Scene few =
      scene_of("hull() { cylinder(h = 1, r1 = 2, r2 = 2, $fn = 6); " + kMoved + "cube(1); }");
  CHECK(std::holds_alternative<PolyhedronShape>(few.objects[0].csg.value));
  const Scene facets =
      scene_of("hull() { sphere(r = 1); " + kMoved + "sphere(r = 1); }", {.facets = true});
  CHECK_FALSE(std::holds_alternative<OperationNode>(facets.objects[0].csg.value));
  CHECK(warnings_of("linear_extrude(height = 1) offset(r = 1, $fn = 6) square(size = 3);").empty());
}

TEST_CASE("a sum that has no exact form asks for OpenSCAD") {
  CHECK(errors_of("minkowski() { difference() { cube(3); cube(1); } sphere(r = 1); }") ==
        std::vector<std::string>{"1: minkowski() needs the program openscad, which is not there"});
}

TEST_CASE("a hull takes a sum's operands for what they are") {
  check_within(
      "hull() { minkowski() { cube(size = [4, 6, 4]); sphere(r = 1); } " + kMoved +
          "minkowski() { cube(size = [0.5, 6, 4]); sphere(r = 1); } }",
      [](const Vec3& p) {
        return from_box(p, {}, {8.5, 6, 4});
      },
      1);
}

TEST_CASE("the camera is framed for corners that a round hull keeps") {
  const Scene scene = scene_of("hull() { cube(size = [30, 1, 1]); sphere(r = 1); }");
  CHECK(scene.settings.camera.look_at.x > 10);
}

}  // namespace
}  // namespace graycube
