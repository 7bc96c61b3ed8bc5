// Arguments of wrong types and sizes: one part suffers, and is named, and the rest is there. What
// takes their place was seen with openscad 2021.01.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

/// What a reading of the text leaves out or passes over, with its place.
std::vector<std::string> left_out(const std::string& text) {
  std::vector<std::string> lines;
  for (const ImportWarning& w : read_openscad_csg(text).warnings) {
    if (w.leaves_out) lines.push_back(w.where + ": " + w.text);
  }
  return lines;
}

std::vector<SceneObject> objects_of(const std::string& text) { return scene_of(text).objects; }

struct Replaced {
  const char *wrong, *right;
};

TEST_CASE("an argument of a wrong type counts as not given, as in OpenSCAD, and is named") {
  const Replaced replaced[] = {
      {"cube(size = \"a\");", "cube();"},
      {"cube(size = [1, 2]);", "cube();"},
      {"cube(size = [1, 2, 3, 4]);", "cube();"},
      {"cube(size = [3, \"a\", 3]);", "cube();"},
      {"cube(size = 2, center = 1);", "cube(size = 2);"},
      {"sphere(r = [1]);", "sphere();"},
      {"sphere(d = \"x\", r = 2);", "sphere(r = 2);"},
      {"sphere(r = 2, $fn = \"x\");", "sphere(r = 2);"},
      {"cylinder(h = \"x\", r = 2);", "cylinder(r = 2);"},
      {"cylinder(h = 2, r1 = \"x\", r2 = 3);", "cylinder(h = 2, r2 = 3);"},
      {"cylinder(h = 2, d = \"x\", r = 3);", "cylinder(h = 2, r = 3);"},
      {"cylinder(h = 2, r = 1, center = [1]);", "cylinder(h = 2, r = 1);"},
      {"linear_extrude(height = \"x\") square(2);", "linear_extrude(height = 100) square(2);"},
      {"linear_extrude(height = inf) square(2);", "linear_extrude(height = 100) square(2);"},
      {"linear_extrude(height = 5, twist = nan) square(2);",
       "linear_extrude(height = 5) square(2);"},
      {"linear_extrude(height = 5, scale = [2]) square(2);",
       "linear_extrude(height = 5) square(2);"},
      {"linear_extrude(height = 5, scale = [2, inf]) square(2);",
       "linear_extrude(height = 5) square(2);"},
      {"linear_extrude(height = 5, twist = 90, slices = \"x\") square(2);",
       "linear_extrude(height = 5, twist = 90) square(2);"},
      {"linear_extrude(height = 5) square(size = [2, 3, 4]);",
       "linear_extrude(height = 5) square(1);"},
      {"linear_extrude(height = 5) circle(r = \"x\");", "linear_extrude(height = 5) circle(1);"},
      {"linear_extrude(height = 5) offset(r = \"x\") square(2);",
       "linear_extrude(height = 5) offset(r = 1) square(2);"},
      {"linear_extrude(height = 5) offset(delta = 1, chamfer = 1) square(2);",
       "linear_extrude(height = 5) offset(delta = 1) square(2);"},
      {"linear_extrude(height = 5) polygon(points = [[0, 0], [2, 0], [0, 2]], paths = \"x\");",
       "linear_extrude(height = 5) polygon(points = [[0, 0], [2, 0], [0, 2]]);"},
      {"linear_extrude(height = 5) polygon([[0, 0], [2, 0], [2, 2], [0, 2]], [\"x\", [0, 1, 2]]);",
       "linear_extrude(height = 5) polygon([[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 2]]);"},
      {"linear_extrude(height = 5) polygon([[0, 0], [2, 0], [2, 2]], [1, [0, 1, 2]]);",
       "linear_extrude(height = 5) polygon([[0, 0], [2, 0], [2, 2]], [[0, 1, 2]]);"},
      {"rotate_extrude(angle = \"x\") polygon([[3, 0], [4, 0], [4, 1]]);",
       "rotate_extrude() polygon([[3, 0], [4, 0], [4, 1]]);"},
      {"multmatrix(3) cube(2);", "cube(2);"},
      {"multmatrix([[1, 0, 0, 5], [0, \"x\", 0, 2]]) cube(2);",
       "multmatrix([[1, 0, 0, 5], [0, 1, 0, 2]]) cube(2);"},
      {"color(\"red\") cube(2);", "cube(2);"},
      {"color([1, \"x\", 0]) cube(2);", "cube(2);"},
      {"color([1, 0, 0], alpha = \"x\") cube(2);", "color([1, 0, 0]) cube(2);"},
  };
  for (const Replaced& r : replaced) {
    INFO(r.wrong);
    CHECK(objects_of(r.wrong) == objects_of(r.right));
    CHECK(left_out(r.right).empty());
    const std::vector<std::string> told = left_out(std::string("\n") + r.wrong);
    REQUIRE(told.size() == 1);
    CHECK(told[0].starts_with("line 2: "));
    CHECK(told[0].ends_with("as in OpenSCAD it counts as not given"));
  }
  CHECK(left_out("\ncube(size = [1, 2]);")[0] ==
        "line 2: cube(): size must be a number or three numbers; as in OpenSCAD it counts as not "
        "given");
}

TEST_CASE("where nothing takes its place only the part is left out, and is named") {
  const char* const parts[] = {
      "cube(1e31);",
      "multmatrix([[1, 0, 0, 1e200]]) multmatrix([[1e150, 0, 0, 0]]) sphere(1e300);",
      "hull() { cube(1e31); sphere(1, $fn = 5); }",
      "linear_extrude(height = 5, scale = 1e31) square(2);",
      "linear_extrude(height = 5) offset(r = nan) square(2);",
      "polyhedron(points = [[0, 0, 0], [1, 0, 0], \"x\"], faces = [[0, 1, 2]]);",
  };
  for (const char* part : parts) {
    INFO(part);
    const std::string rest = "cube(2);";
    CHECK(objects_of(rest + "\n" + part).size() == 1);
    const std::vector<std::string> told = left_out(rest + "\n" + part);
    REQUIRE(told.size() == 1);
    CHECK(told[0].starts_with("line 2: "));
    CHECK(told[0].find("is left out: ") != std::string::npos);
    CHECK(errors_of(part) == std::vector<std::string>{"0: nothing is left of the model"});
  }
}

TEST_CASE("a round solid of too many facets is left out alone") {
  OpenscadOptions facets;
  facets.facets = true;
  const std::string text = "cube(2);\nsphere(r = 2, $fn = 1e9);";
  CHECK(scene_of(text).objects.size() == 2);
  const OpenscadResult result = read_openscad_csg(text, facets);
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 1);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0] ==
        ImportWarning{"line 2", "sphere() is left out: it has more than 1048576 facets", true});
}

TEST_CASE("points and faces that are none are passed over as long as nothing needs them") {
  const std::string solid = "[[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]";
  const std::string points = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]";
  const auto made = [&](const std::string& more_points, const std::string& more_faces) {
    return objects_of("polyhedron(" + points + more_points + "], " + solid + more_faces + "]);");
  };
  CHECK(made(", \"x\"", "") == made("", ""));
  CHECK(made("", ", \"x\"") == made("", ""));
}

TEST_CASE("slices of 0 and less are as many as the twist needs") {
  const auto sliced = [](const std::string& slices) {
    return objects_of("linear_extrude(height = 5, twist = 90" + slices + ") square(2);");
  };
  CHECK(sliced(", slices = 0") == sliced(""));
  CHECK(sliced(", slices = -3") == sliced(""));
  CHECK_FALSE(sliced(", slices = 1") == sliced(""));
}

TEST_CASE("of a diameter and a radius the diameter counts") {
  CHECK(objects_of("cylinder(h = 2, r = 3, d = 2);") == objects_of("cylinder(h = 2, r = 1);"));
  CHECK(objects_of("sphere(r = 3, d = 2);") == objects_of("sphere(1);"));
}

}  // namespace
}  // namespace graycube
