// hull() and minkowski() of round solids, as OpenSCAD means them.

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/within.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

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
                                 "what is round around it is exact, unless it is flush with it"});
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
