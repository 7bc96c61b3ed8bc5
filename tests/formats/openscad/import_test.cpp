#include "catch.hpp"
#include "formats/openscad/fixture.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

constexpr const char* kFlatMatrix =
    "multmatrix([[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])";

bool is_empty(const std::string& text) { return scene_of(text).objects.empty(); }

template <typename Shape>
Shape only_shape(const std::string& text) {
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 1);
  REQUIRE(std::holds_alternative<Shape>(scene.objects[0].csg.value));
  return std::get<Shape>(scene.objects[0].csg.value);
}

TEST_CASE("a file of every module gives the solids that OpenSCAD shows") {
  const Scene scene = scene_of(fixture("every_module.csg"));
  CHECK(scene.objects.size() == 14);
  const auto in = [&](double x, double y, double z) { return holds(scene, {x, y, z}); };
  SECTION("the centred cube") { CHECK((in(-1.9, -2.9, -3.9) && !in(2.1, 0, 0) && !in(0, 0, 4.1))); }
  SECTION("the sphere, round") { CHECK((in(12, 0, 2.99) && in(12, 2.99, 0) && !in(14.2, 2.2, 0))); }
  SECTION("the cylinder stands on z = 0") {
    CHECK((in(24, 1.99, 0.01) && !in(24, 0, -0.01) && !in(24, 0, 5.01)));
  }
  SECTION("the cone is wide below") {
    CHECK((in(38.9, 0, -2.9) && in(36, 0.9, 2.9) && !in(36, 1.2, 2.9)));
  }
  SECTION("the prism has a corner at angle 0 and a side at 30°") {
    CHECK((in(50.99, 0, 2) && in(48, 2.59, 2) && !in(48, 2.7, 2)));
  }
  SECTION("the polyhedron, its base of two triangles") {
    CHECK((in(72, 0, 3.9) && in(69.1, -2.9, 0.01) && !in(72, 0, -0.1)));
  }
  SECTION("the difference: # cuts, % doesn't") {
    CHECK((in(82, 0, 2.9) && !in(84, 0, 0) && !in(86.5, 2.5, 2.5) && in(84, 2.5, 0)));
  }
  SECTION("the intersection") { CHECK((in(98.9, 0, 0) && !in(98.9, 2.9, 0) && !in(99.1, 0, 0))); }
  SECTION("mirrored, sheared by an uneven scale") {
    CHECK((in(118.95, 2.37, 1) && !in(121.05, 2.37, 1) && !in(118.95, 1, 1)));
  }
  SECTION("the loop") { CHECK((in(133, 1, 1) && in(133, 9, 1) && !in(133, 5, 1))); }
}

TEST_CASE("the volumes are those of the meshes that OpenSCAD exports") {
  const auto of = [](const std::string& text) {
    return volume(scene_of(text), {-1, -1, -1}, {1, 1, 1}, 64);
  };
  CHECK(of("sphere($fn = 8.9, r = 1);") == Approx(3.22905).epsilon(0.01));
  CHECK(of("sphere($fn = 5, r = 1);") == Approx(2.40228).epsilon(0.01));
  CHECK(of("sphere($fn = 1, r = 1);") == Approx(0.918559).epsilon(0.01));
  CHECK(of("cylinder($fn = 2, h = 1, r1 = 1, r2 = 1);") == Approx(1.2990375).epsilon(0.01));
  CHECK(of("cylinder($fn = 4, h = 2, r1 = 1, r2 = 0, center = true);") ==
        Approx(4.0 / 3).epsilon(0.01));
  CHECK(of("multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]) cube(1);") ==
        Approx(0.125).epsilon(0.01));
}

TEST_CASE("spheres and cylinders are exact unless $fn asks for few sides") {
  for (const char* fn : {"0", "9", "100", "-5", "inf", "nan", "undef"}) {
    INFO(fn);
    CHECK(
        only_shape<SphereShape>("sphere($fn = " + std::string(fn) + ", $fa = 30, $fs = 9, r = 2);")
            .radius == 2);
    CHECK(
        only_shape<CylinderShape>("cylinder($fn = " + std::string(fn) + ", h = 3, r1 = 1, r2 = 1);")
            .radius == 1);
  }
  CHECK(only_shape<ConeShape>("cylinder(h = 3, r1 = 0, r2 = 1);").base_radius == 0);
  for (int sides = 3; sides <= 8; ++sides) {
    const std::string fn = "($fn = " + std::to_string(sides);
    const auto n = static_cast<std::size_t>(sides);
    const std::size_t rings = (n + 1) / 2;
    CHECK(
        only_shape<PolyhedronShape>("cylinder" + fn + ", h = 3, r1 = 2, r2 = 1);").planes.size() ==
        n + 2);
    CHECK(
        only_shape<PolyhedronShape>("cylinder" + fn + ", h = 3, r1 = 2, r2 = 0);").planes.size() ==
        n + 1);
    CHECK(only_shape<PolyhedronShape>("sphere" + fn + ", r = 2);").planes.size() ==
          n * (rings - 1) + 2);
  }
}

TEST_CASE("defaults and other ways to say a size are OpenSCAD's") {
  CHECK(only_shape<BoxShape>("cube();").max == Vec3{1, 1, 1});
  CHECK(only_shape<BoxShape>("cube(3, true);").min == Vec3{-1.5, -1.5, -1.5});
  CHECK(only_shape<SphereShape>("sphere();").radius == 1);
  CHECK(only_shape<SphereShape>("sphere(d = 3);").radius == 1.5);
  CHECK(only_shape<CylinderShape>("cylinder(5, 2, 2);").radius == 2);
  CHECK(only_shape<CylinderShape>("cylinder(h = 5, d = 3);").radius == 1.5);
  CHECK(only_shape<ConeShape>("cylinder(h = 5, d1 = 3, r2 = 1);").base_radius == 1.5);
}

TEST_CASE("what has no volume is left out with a warning") {
  for (const char* text :
       {"cube(0);", "cube([1, 0, 2]);", "cube(-1);", "cube([inf, 1, 1]);", "sphere(r = 0);",
        "sphere(r = -2);", "sphere(r = -nan);", "sphere($fn = 4, r = 0);",
        "cylinder(h = 0, r1 = 1, r2 = 1);", "cylinder(h = 2, r1 = 0, r2 = 0);",
        "cylinder(h = -2, r1 = 3, r2 = 3);", "cylinder(h = 3, r1 = -1, r2 = 2);",
        "multmatrix([[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(1);",
        "multmatrix([[nan, 0, 0, 0]]) cube(1);", "multmatrix([[inf, 0, 0, 0]]) cube(1);",
        "cube([1, 1, 1e-40]);",
        "polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces = [[0, 1, 2], [2, 1, 0]]);",
        "polyhedron(points = [], faces = []);"}) {
    INFO(text);
    CHECK(is_empty(text));
    const auto warnings = warnings_of(text);
    REQUIRE(warnings.size() == 2);
    CHECK_THAT(warnings[0], Catch::StartsWith("line 1: ") && Catch::Contains("() is left out: "));
    CHECK(warnings[1] == "the model is empty");
  }
}

TEST_CASE("a union passes over its empty operands") {
  const Scene scene =
      scene_of("union() { group(); cube(1); intersection(); difference(); union(); }");
  REQUIRE(scene.objects.size() == 1);
  CHECK(std::holds_alternative<BoxShape>(scene.objects[0].csg.value));
}

TEST_CASE("an intersection with an empty operand is empty") {
  CHECK(is_empty("intersection() { cube(3); group(); }"));
  CHECK(is_empty("intersection() { union(); cube(3); }"));
  CHECK(is_empty("intersection() { cube(3); cube(0); }"));
  CHECK(is_empty(std::string("intersection() { cube(3); ") + kFlatMatrix + " cube(1); }"));
  CHECK(is_empty("intersection() { cube(3); difference() { group(); cube(1); } }"));
  CHECK(is_empty("intersection() { cube(3); color([1, 0, 0, 1]); }"));
  CHECK(is_empty("intersection() { cube(3); multmatrix([[1, 0, 0, 9]]) sphere(5); }"));
  CHECK(is_empty("intersection();"));
}

TEST_CASE("operands that % or * leave out don't count, not even as empty ones") {
  CHECK(only_shape<BoxShape>("intersection() { cube(3); %cube(1); }").max.x == 3);
  CHECK(only_shape<BoxShape>("intersection() { *sphere(9); cube(3); }").max.x == 3);
  CHECK(only_shape<BoxShape>("difference() { cube(3); %cube(1); }").max.x == 3);
  const Scene scene = scene_of("difference() { %cube(1); cube(3); cube(2); }");
  CHECK((holds(scene, {2.5, 2.5, 2.5}) && !holds(scene, {1, 1, 1})));
  CHECK(is_empty("%group() { cube(1); } *sphere(1);"));
  CHECK(errors_of("%hull() { cube(1); }\n*text();").empty());
}

TEST_CASE("a difference is empty when its first operand is, and whole when nothing is taken off") {
  CHECK(is_empty("difference() { group(); cube(3); }"));
  CHECK(is_empty("difference() { cube(0); cube(3); }"));
  CHECK(is_empty("difference();"));
  CHECK(only_shape<BoxShape>("difference() { cube(3); }").max.x == 3);
  CHECK(only_shape<BoxShape>("difference() { cube(3); cube(0); group(); }").max.x == 3);
}

TEST_CASE("a group is one operand, the union of its children") {
  const Scene scene = scene_of("difference() { group() { cube(3); cube([1, 1, 9]); } cube(2); }");
  CHECK(volume(scene, {0, 0, 0}, {9, 9, 9}, 27) == Approx(25));
  const Scene common = scene_of(
      "intersection() { group() { cube(3); multmatrix([[1, 0, 0, 8]]) cube(1); } cube([9, 1, 1]); "
      "}");
  CHECK(volume(common, {0, 0, 0}, {9, 9, 9}, 27) == Approx(4));
}

TEST_CASE("with ! the rest of the file doesn't count, nor do the transforms around it") {
  const Scene scene =
      scene_of("cube(9);\nmultmatrix([[1, 0, 0, 50]]) { sphere(4); !cube(2); }\n!cube(5);");
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].csg.transform == std::nullopt);
  CHECK(std::get<BoxShape>(scene.objects[0].csg.value).max.x == 2);
}

TEST_CASE("a sphere under a written rotation and an even scale stays a sphere") {
  const std::string turned =
      "multmatrix([[2, 0, 0, 5], [0, 2, 0, 6], [0, 0, -2, 7], [0, 0, 0, 1]]) "
      "multmatrix([[0.813798, -0.44097, 0.378522, 0], [0.469846, 0.882564, 0.0180283, 0], "
      "[-0.34202, 0.163176, 0.925417, 0], [0, 0, 0, 1]]) ";
  const Scene scene = scene_of(turned + "sphere(r = 3);");
  REQUIRE(scene.objects[0].csg.transform == std::nullopt);
  const auto sphere = std::get<SphereShape>(scene.objects[0].csg.value);
  CHECK(sphere.center == Vec3{5, 6, 7});
  CHECK(sphere.radius == Approx(6).epsilon(2e-6));
  CHECK(scene_of("multmatrix([[1, 0, 0, 0], [0, 1.0001, 0, 0]]) sphere(1);")
            .objects[0]
            .csg.transform.has_value());
}

TEST_CASE("matrices multiply from the outside in") {
  const Scene scene = scene_of(
      "multmatrix([[0, -1, 0, 10], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) multmatrix([[2, 0, "
      "0, 1], [0, 1, 0, 0]]) cube(1);");
  CHECK((holds(scene, {9.5, 1.5, 0.5}) && holds(scene, {9.5, 2.9, 0.5}) &&
         !holds(scene, {9.5, 0.5, 0.5})));
}

TEST_CASE("without OpenSCAD what needs it is an error naming its line") {
  // The sum of a cube and a sphere in line 12 doesn't need the program.
  const std::vector<std::string> expected{
      "25: text() needs the program openscad, which is not there"};
  CHECK(errors_of(fixture("for_openscad.csg")) == expected);
}

TEST_CASE("a module that no .csg file has is an error naming it and its line") {
  CHECK(
      errors_of("frobnicate(1);")[0].starts_with("1: frobnicate() is not a module of .csg files"));
}

TEST_CASE("arguments the reader doesn't know are passed over") {
  CHECK(only_shape<BoxShape>("cube(size = 2, timestamp = 0, $fe = undef, note = \"a\");").max.x ==
        2);
}

TEST_CASE("operations may nest as deep as the renderer's trees, and no deeper") {
  const auto nested = [](int depth) {
    std::string text;
    for (int i = 0; i < depth; ++i) text += "difference() {\n";
    text += "cube(9);";
    for (int i = 0; i < depth; ++i) text += "sphere(1); }";
    return text;
  };
  CHECK(errors_of(nested(254)).empty());
  CHECK(errors_of(nested(255)) == std::vector<std::string>{"0: nothing is left of the model"});
  CHECK(warnings_of(nested(255)) ==
        std::vector<std::string>{
            "line 1: difference() is left out: it has more than 255 levels of operations"});
}

TEST_CASE("more solids than a model may have are an error that names the limit") {
  std::string text;
  for (std::size_t i = 0; i < kMaxOpenscadSolids; ++i) text += "cube();";
  text += "\ncube();\ncube();";
  CHECK(errors_of(text) == std::vector<std::string>{"2: more than 524288 solids in a model"});
}

TEST_CASE("an empty file is an empty scene with a warning") {
  for (const char* text : {"", "\n", "// nothing", ";;", "group();"}) {
    CHECK(is_empty(text));
    CHECK(warnings_of(text) == std::vector<std::string>{"the model is empty"});
  }
}

}  // namespace
}  // namespace graycube
