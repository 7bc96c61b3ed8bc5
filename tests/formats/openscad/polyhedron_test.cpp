// polyhedron(): what faces and points of all kinds enclose, and what hulls make of them.
#include <algorithm>
#include <string>
#include <utility>

#include "catch.hpp"
#include "formats/openscad/leaf_meshes.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kTetrahedron = "[[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]";

/// The only object's planes.
std::size_t planes_of(const std::string& text) {
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 1);
  return std::get<PolyhedronShape>(scene.objects[0].csg.value).planes.size();
}

bool is_left_out(const std::string& text) {
  const OpenscadResult result = read_openscad_csg(text);
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [](const ImportWarning& w) { return w.leaves_out; });
}

TEST_CASE("in a hull a polyhedron counts by the corners of its faces, closed or not") {
  const std::string open = "hull() polyhedron(points = " + kTetrahedron +
                           ", [3, 3, 3], [90, 90, 90]], faces = [[0, 1, 2, 3, 4]]);";
  CHECK(warnings_of(open).empty());
  CHECK(planes_of(open) == 6);
  // The pyramid over the tetrahedron's slanted face doubles its volume and a quarter.
  CHECK(volume(scene_of(open), {0, 0, 0}, {4, 4, 4}, 80) == Approx(24).epsilon(0.01));
}

TEST_CASE("what is flattened counts in a hull, and nowhere else") {
  const std::string sheet = "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0]]) cube(1);";
  const std::string upper = "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3]]) cube(1);";
  CHECK(volume(scene_of("hull() { " + sheet + upper + " }"), {0, 0, 0}, {1, 1, 4}) == Approx(4));
  CHECK(volume(scene_of(sheet + upper), {0, 0, 0}, {1, 1, 4}) == Approx(1));
  // A flattened cylinder counts by its sides.
  const std::string disc =
      "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 5]]) cylinder(h = 1, r1 = 3, r2 = 3, "
      "$fn = 12);";
  const Scene scene = scene_of("hull() { " + disc + " cube(2); }");
  CHECK(holds(scene, {2.5, 0.5, 4.9}));
  CHECK_FALSE(holds(scene, {2.9, 0.1, 2}));
}

TEST_CASE("a bent face over a square is cut where OpenSCAD cuts it") {
  // openscad's own volume is 4.666667; across the other diagonal it would be 5.333333.
  const Scene scene = scene_of(
      "polyhedron(points = [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 1], "
      "[2, 2, 1], [0, 2, 1]], faces = [[0, 1, 2, 3], [7, 6, 5, 4], [4, 5, 1, 0], [5, 6, 2, 1], "
      "[6, 7, 3, 2], [7, 4, 0, 3]]);");
  CHECK(mesh_volume(meshes_of(scene)) == Approx(14.0 / 3));
}

TEST_CASE("points that no face uses frame nothing") {
  const std::string faces = "], faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]]);";
  const Scene with = scene_of("polyhedron(points = " + kTetrahedron + ", [900, 900, 900]" + faces);
  const Scene without = scene_of("polyhedron(points = " + kTetrahedron + faces);
  CHECK(with.settings.camera == without.settings.camera);
  CHECK(with.objects == without.objects);
}

TEST_CASE("written corners that differ enclose volume, however thin or shallow it is") {
  const std::string box =
      "], faces = [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], [5, 6, 2, 1], [6, 7, 3, 2], "
      "[7, 4, 0, 3]]);";
  CHECK(planes_of("polyhedron(points = [[0, 0, 100], [10, 0, 100], [10, 10, 100], [0, 10, 100], "
                  "[0, 0, 100.001], [10, 0, 100.001], [10, 10, 100.001], [0, 10, 100.001]" +
                  box) == 6);
  const auto dented = meshes_of(scene_of(
      "polyhedron(points = [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0], [0, 0, 1000], "
      "[10, 0, 1000], [10, 10, 1000], [0, 10, 1000], [5, 5, 999.99]], faces = [[0, 1, 2, 3], "
      "[4, 5, 1, 0], [8, 5, 4], [8, 6, 5], [8, 7, 6], [8, 4, 7], [5, 6, 2, 1], [6, 7, 3, 2], "
      "[7, 4, 0, 3]]);"));
  REQUIRE(dented.size() == 1);
  CHECK(mesh_volume(dented) == Approx(99999.6666667).epsilon(1e-9));
}

TEST_CASE("a polyhedron that is open is left out alone, with the place where it is open") {
  const std::string open = "cube(1);\npolyhedron(points = " + kTetrahedron +
                           "], faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2]]);";
  CHECK(scene_of(open).objects.size() == 1);
  CHECK(is_left_out(open));
  const auto warnings = warnings_of(open + "\n" + open);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Catch::StartsWith("line 2: polyhedron() is left out: ") &&
                              Catch::Contains("not closed: the edge from (") &&
                              Catch::EndsWith("(and 1 more like it)"));
}

TEST_CASE("faces that a polyhedron has twice or three times are ignored, which is told") {
  const std::string points = "polyhedron(points = " + kTetrahedron + "], faces = [";
  const std::string sides = "[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]";
  // OpenSCAD 2021.01 makes the tetrahedron of all of these.
  for (const auto& [more, told] :
       {std::pair{", [1, 2, 0], [2, 0, 1]", "2 of its 6 faces"},
        std::pair{", [2, 1, 0]", "1 of its 5 faces"},
        std::pair{", [2, 1, 0], [1, 3, 0], [2, 3, 1], [3, 2, 0]", "4 of its 8 faces"}}) {
    INFO(more);
    const std::string text = "cube(1);\n" + points + sides + more + "]);";
    CHECK(volume(scene_of(text), {0, 0, 0}, {4, 4, 4}, 80) == Approx(64.0 / 6).epsilon(0.01));
    CHECK_FALSE(is_left_out(text));
    REQUIRE(warnings_of(text).size() == 1);
    CHECK_THAT(warnings_of(text)[0], Catch::StartsWith("line 2: polyhedron(): ") &&
                                         Catch::Contains(told) && Catch::Contains("are ignored"));
  }
  CHECK(is_left_out("cube(1);\n" + points + "[0, 1, 2], [0, 3, 1], [0, 3, 1], [1, 3, 2]]);"));
}

TEST_CASE("a path of a polygon without a list around it makes nothing, which is told") {
  const std::string text =
      "cube(1);\nlinear_extrude(height = 2) polygon(points = [[0, 0], [4, 0], [0, 4]], "
      "paths = [0, 1, 2]);";
  CHECK(scene_of(text).objects.size() == 1);
  REQUIRE(warnings_of(text).size() == 1);
  CHECK_THAT(warnings_of(text)[0], Catch::Contains("paths must be lists"));
}

TEST_CASE("a polyhedron without points or faces is left out alone") {
  for (const char* arguments : {"", "points = undef, faces = [[0, 1, 2]]",
                                "points = [[0, 0, 0], [1, 1, 1]], faces = undef"}) {
    const std::string text = std::string("cube(1);\npolyhedron(") + arguments + ");";
    INFO(text);
    CHECK(scene_of(text).objects.size() == 1);
    CHECK(is_left_out(text));
  }
}

TEST_CASE("faces' corners that differ by rounding are one") {
  const auto box = meshes_of(scene_of(
      "polyhedron(points = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [1, 1, 0], [0, 0, 2], [4, 0, 2], "
      "[4, 3, 2], [1, 1, 2], [-5.55112e-17, -5.55112e-17, 2], [4, -5.55112e-17, 2], [4, 3, 2], "
      "[1, 1, 2]], faces = [[0, 1, 2, 3], [4, 5, 1, 0], [5, 6, 2, 1], [6, 7, 3, 2], "
      "[7, 4, 0, 3], [11, 10, 9, 8]]);"));
  REQUIRE(box.size() == 1);
  CHECK(mesh_volume(box) == Approx(13));
  CHECK(box.front().points.size() == 8);
}

TEST_CASE("repeated and strange corners, faces of two and points of two numbers are passed over") {
  const std::string points = "[[0, 0], [4, 0], [4, 4], [0, 4], [2, 2, 4], [2, 0, 0]]";
  const auto with_faces = [&](const std::string& faces) {
    return "polyhedron(points = " + points + ", faces = [" + faces + "]);";
  };
  const std::string sides = "[4, 1, 0], [4, 2, 1], [4, 3, 2], [4, 0, 3]";
  CHECK(planes_of(with_faces("[0, 0, 1, 2, 2, 3], [0, 1], [], " + sides)) == 5);
  CHECK(planes_of(with_faces("[0, 5, 1, 2, 3], [4, 1, 5], [4, 5, 0], [4, 2, 1], [4, 3, 2], "
                             "[4, 0, 3]")) == 5);
  const std::string strange = with_faces("[0, 1, 77, 2, -1, 3], " + sides);
  CHECK(planes_of(strange) == 5);
  CHECK(warnings_of(strange) ==
        std::vector<std::string>{
            "line 1: polyhedron(): face 0 names a point that isn't there, which is ignored"});
  for (const char* faces : {"[0, 1, \"2\"]", "[0, 1, [2]]"}) {
    CHECK(is_left_out(with_faces(faces)));
    CHECK(errors_of("cube(1);\n" + with_faces(faces)).empty());
  }
  CHECK(is_left_out("polyhedron(points = [[0, 0, \"a\"]], faces = [[0, 0, 0]]);"));
}

TEST_CASE("of a matrix's fourth row only the last entry counts") {
  const std::string text =
      "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.1, 0, 0, 2]]) cube(4);";
  CHECK(volume(scene_of(text), {0, 0, 0}, {4, 4, 4}, 40) == Approx(8));
  CHECK(warnings_of(text).size() == 1);
}

TEST_CASE("a module without a shape in it is nothing, whatever it does") {
  for (const char* empty : {"offset(r = 1) group();", "offset(r = 1);", "hull() group();",
                            "minkowski();", "fill();", "resize(newsize = [1, 1, 1]) group();",
                            "roof();", "linear_extrude(height = 2) offset(r = 1) group();",
                            "linear_extrude(height = 2) projection() group();"}) {
    INFO(empty);
    CHECK(scene_of("cube(1);" + std::string(empty)).objects.size() == 1);
    CHECK(warnings_of("cube(1);" + std::string(empty)).empty());
  }
}

/// Answers whatever it is asked.
class Answering : public OpenscadProgram {
 public:
  explicit Answering(Result result) : result_(std::move(result)) {}
  Result evaluate(const std::string& /*csg*/, Format /*format*/) override { return result_; }

 private:
  Result result_;
};

TEST_CASE("what openscad can't make, or doesn't know, is left out alone, in its own words") {
  const std::string text =
      "cube(1);\nroof(method = \"voronoi\") square(size = [4, 2]);\nlinear_extrude(height = 1) "
      "text(text = \"a\");";
  for (const auto& [trouble, told] :
       {std::pair<std::string, std::string>{"no memory", "no memory"}, {"", "doesn't know it"}}) {
    Answering program({"", trouble});
    OpenscadOptions options;
    options.program = &program;
    const OpenscadResult result = read_openscad_csg(text, options);
    REQUIRE(result.scene);
    CHECK(result.scene->objects.size() == 1);
    std::vector<ImportWarning> left;
    for (const ImportWarning& w : result.warnings) {
      if (w.leaves_out) left.push_back(w);
    }
    REQUIRE(left.size() == (trouble.empty() ? 1 : 2));
    CHECK(left[0].where == "line 2");
    CHECK_THAT(left[0].text, Catch::StartsWith("roof() is left out: ") && Catch::Contains(told));
  }
}

TEST_CASE("fill() fills the holes of a figure") {
  const Scene scene = scene_of(
      "linear_extrude(height = 5) fill() difference() { square(size = [4, 4]); "
      "multmatrix([[1, 0, 0, 1], [0, 1, 0, 1]]) square(size = [1, 1]); }");
  REQUIRE(scene.objects.size() == 1);
  const auto& prism = std::get<PrismShape>(scene.objects[0].csg.value);
  CHECK(prism.points.size() == 4);
  CHECK(prism.height == 5);
}

}  // namespace
}  // namespace graycube
