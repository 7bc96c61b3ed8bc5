// How the solids of a .csg file become objects, and its colours materials.

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/openscad/fixture.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/openscad/reading.hpp"
#include "formats/pov/scene_membership.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

TEST_CASE("what is intersected with a flat shape, or with nothing, is nothing") {
  for (const char* other : {"circle(r = 2);", "square(size = [0, 0]);", "minkowski();", "render();",
                            "linear_extrude(height = 1);", "cube(size = [0, 0, 0]);"}) {
    INFO(other);
    const std::string text = std::string("intersection() { cube(4); ") + other + " }";
    CHECK(scene_of("cube(1);\n" + text).objects.size() == 1);
  }
}

double flat_area(const std::vector<FlatPoint>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const FlatPoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return std::fabs(sum);
}

// Areas by OpenSCAD 2021.01.
TEST_CASE("a flat sum is empty where its first operand is, or all others are") {
  const auto area = [](const std::string& operands) {
    const std::string aside =
        "multmatrix([[1, 0, 0, 9], [0, 1, 0, 9], [0, 0, 1, 9], [0, 0, 0, 1]]) cube(1);\n";
    const std::string text = "linear_extrude(height = 1) minkowski() { " + operands + " }\n";
    const Scene scene = scene_of(aside + text);
    if (scene.objects.size() == 1) return 0.0;
    return flat_area(std::get<PrismShape>(scene.objects.at(1).csg.value).points);
  };
  const std::string two = "square(size = [2, 2]);", one = "square(size = [1, 1]);";
  for (const std::string none :
       {"circle(r = 0);", "group();", "difference() { square(1); square(size = [2, 2]); }",
        "cube(1);"}) {
    INFO(none);
    CHECK(area(two + none) == 0);
    CHECK(area(none + two) == 0);
    CHECK(area(none + two + one) == 0);
    CHECK(area(two + none + none) == 0);
    CHECK(area(two + none + one) == Approx(9));
    CHECK(area(two + one + none) == Approx(9));
  }
  CHECK(area(two + "%" + one) == Approx(4));
}

TEST_CASE("an offset whose moved sides cross too often is left out with its name") {
  std::string points;
  for (int i = 0; i < 40000; ++i) {
    const double angle = 0.00015707963267948966 * i, radius = 100 + i * 7919 % 97 * 0.1;
    points += "[" + std::to_string(radius * std::cos(angle)) + ", " +
              std::to_string(radius * std::sin(angle)) + "],";
  }
  points.pop_back();
  const std::string text =
      "cube(1);\nlinear_extrude(height = 1) offset(r = 1000, $fn = 1000) {\n"
      "polygon(points = [" +
      points + "], paths = undef);\n}\n";
  CHECK(scene_of(text).objects.size() == 1);
  const auto warnings = warnings_of(text);
  CHECK(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.starts_with("line 2: offset() is left out: its outline");
  }));
}

TEST_CASE("parts outside of any operation are objects of their own") {
  const Scene scene = scene_of(
      "group() { cube(1); union() { sphere(1); render() difference() { cube(2); sphere(1); } } }\n"
      "intersection() { cube(3); sphere(2); }");
  REQUIRE(scene.objects.size() == 4);
  CHECK(scene.objects[0].name == "part 1: cube, line 1");
  CHECK(scene.objects[3].name == "part 4: intersection, line 2");
  CHECK(scene.materials.size() == 1);
  for (const SceneObject& object : scene.objects) CHECK(object.material == 0);
}

TEST_CASE("a file with a transparent part is one object, so that no inner surface shows") {
  const Scene scene = scene_of(
      "color([0, 0, 1, 0.25]) cube(2);\nmultmatrix([[1, 0, 0, 1]]) color([1, 0, 0, 1]) cube(2);");
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].material == kInheritMaterial);
  const auto& root = std::get<OperationNode>(scene.objects[0].csg.value);
  REQUIRE(root.operation == Operation::kUnion);
  REQUIRE(root.children.size() == 2);
  CHECK(scene.materials[root.children[0].material].material.transmit == 0.75);
  CHECK(scene.materials[root.children[1].material].material.transmit == 0);
}

TEST_CASE("a colour that is cut away altogether doesn't make the file transparent") {
  CHECK(scene_of("cube(1); sphere(1); difference() { group(); color([0, 0, 1, 0.25]) cube(2); }")
            .objects.size() == 2);
}

TEST_CASE("flat parts of a difference keep their colours, and its tools cut all through") {
  const std::string text =
      "difference() { color([1, 0, 0]) square(4); difference() { color([0, 0, 1]) "
      "multmatrix([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0]]) square(2); square(1.5); } }";
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 1);
  const auto& root = std::get<OperationNode>(scene.objects[0].csg.value);
  REQUIRE(root.children.size() == 2);
  const Material& red = scene.materials.at(root.children[0].material).material;
  CHECK((red.color.r == 1 && red.color.b == 0));
  const auto& tool = std::get<OperationNode>(root.children[1].value);
  const Material& blue = scene.materials.at(tool.children.at(0).material).material;
  CHECK((blue.color.r == 0 && blue.color.b == 1));
  // The tool is the square from 1 to 3, less its corner up to 1.5; at every height.
  for (const double z : {-0.49, 0.0, 0.49}) {
    CHECK(any_object_holds(scene, {0.5, 0.5, z}));
    CHECK(any_object_holds(scene, {1.25, 1.25, z}));
    CHECK_FALSE(any_object_holds(scene, {2.5, 2.5, z}));
  }
  CHECK_FALSE(any_object_holds(scene, {0.5, 0.5, 0.51}));
  CHECK_FALSE(any_object_holds(scene, {1.25, 1.25, 0.51}));
}

TEST_CASE("flat parts of an intersection keep their colours") {
  const Scene scene =
      scene_of("intersection() { color([1, 0, 0]) square(2); color([0, 0, 1]) circle(2); }");
  REQUIRE(scene.objects.size() == 1);
  const auto& parts = std::get<OperationNode>(scene.objects[0].csg.value).children;
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].material != parts[1].material);
  CHECK(any_object_holds(scene, {1.4, 1.4, 0}));
  CHECK_FALSE(any_object_holds(scene, {1.5, 1.5, 0}));
  CHECK_FALSE(any_object_holds(scene, {-0.1, 1, 0}));
}

TEST_CASE("colours are sRGB in the file and linear in the scene") {
  const Scene scene = scene_of("color([1, 0.5, 0.02, 1]) cube(1);");
  const Material& material = material_of(scene, 0);
  CHECK(material.color.r == 1);
  CHECK(material.color.g == Approx(0.21404114));
  CHECK(material.color.b == Approx(0.02 / 12.92));
}

TEST_CASE("without a colour a solid has OpenSCAD's yellow") {
  const Scene scene = scene_of("cube(1);");
  CHECK(scene.materials.at(0).name == "default");
  const Rgb color = material_of(scene, 0).color;
  CHECK(color.r == Approx(0.94730654));
  CHECK(color.g == Approx(0.67954255));
  CHECK(color.b == Approx(0.02518686));
}

TEST_CASE("of nested colours the outermost wins") {
  const Scene scene = scene_of("color([1, 0, 0, 1]) group() { color([0, 1, 0, 0.5]) cube(1); }");
  CHECK(material_of(scene, 0).color == Rgb{1, 0, 0});
  CHECK(material_of(scene, 0).transmit == 0);
}

TEST_CASE("a colour that is not given leaves room for one inside, as in OpenSCAD") {
  const std::string red = "color([1, 0, 0, 1]) cube(1);";
  CHECK(material_of(scene_of("color([-1, -1, -1, 1]) " + red), 0).color == Rgb{1, 0, 0});
  CHECK(material_of(scene_of("color() " + red), 0).color == Rgb{1, 0, 0});
  const Scene ghost = scene_of("color([-1, -1, -1, 0.25]) cube(1);");
  CHECK(material_of(ghost, 0).transmit == 0.75);
  CHECK(material_of(ghost, 0).color.r == Approx(0.94730654));
  CHECK(material_of(scene_of("color([2, 0, 0, 7]) cube(1);"), 0).color == Rgb{1, 0, 0});
}

TEST_CASE("what a coloured cutter leaves has the cutter's colour, each leaf its own") {
  const Scene scene = scene_of("difference() { color([1, 0, 0, 1]) cube(3); sphere(1); }");
  CHECK(scene.objects[0].material == kInheritMaterial);
  const auto& root = std::get<OperationNode>(scene.objects[0].csg.value);
  CHECK(scene.materials[root.children[0].material].name == "color 1");
  CHECK(scene.materials[root.children[1].material].name == "cut");
}

TEST_CASE("what a tool without a colour cuts is green, as in OpenSCAD's preview") {
  const Scene scene =
      scene_of("difference() { cube(9); difference() { cube(5); sphere(3); cube(2); } }");
  const auto& root = std::get<OperationNode>(scene.objects[0].csg.value);
  const auto& tool = std::get<OperationNode>(root.children[1].value);
  const auto name = [&](const CsgNode& leaf) { return scene.materials[leaf.material].name; };
  CHECK(name(root.children[0]) == "default");
  CHECK(name(tool.children[0]) == "cut");
  // What is cut from the tool stays of the solid.
  CHECK(name(tool.children[1]) == "default");
  const Rgb green = scene.materials[tool.children[0].material].material.color;
  CHECK(green.r == Approx(0.33716362));
  CHECK(green.g == Approx(0.59720179));
  CHECK(green.b == Approx(0.08228271));
}

TEST_CASE(
    "a colour around a difference is also that of the cut, one inside a render() counts not") {
  CHECK(scene_of("color([1, 0, 0, 1]) difference() { cube(3); sphere(1); }").materials.size() == 1);
  const Scene one = scene_of("render() difference() { color([1, 0, 0, 1]) cube(3); sphere(1); }");
  REQUIRE(one.materials.size() == 1);
  CHECK(one.materials[0].name == "default");
  const Scene tool =
      scene_of("difference() { cube(9); render() difference() { cube(5); sphere(3); } }");
  REQUIRE(tool.materials.size() == 2);
  CHECK(tool.materials[1].name == "cut");
}

TEST_CASE("what is read can be written as a scene file and passes all checks of its reader") {
  for (const std::string& text :
       {fixture("every_module.csg"), std::string("color([0, 0, 1, 0.5]) cube(1); sphere(1);"),
        std::string()}) {
    const std::string written = write_scene_text(scene_of(text));
    const ReadResult again = read_scene_text(written);
    for (const SceneError& error : again.errors) UNSCOPED_INFO(error.pointer << error.message);
    REQUIRE(again.scene);
    CHECK(write_scene_text(*again.scene) == written);
  }
}

}  // namespace
}  // namespace graycube
