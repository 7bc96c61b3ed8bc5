// linear_extrude() and rotate_extrude() against volumes that OpenSCAD 2021.01 gives.
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "formats/openscad/leaf_meshes.hpp"
#include "formats/openscad/reading.hpp"
#include "formats/pov/scene_membership.hpp"
#include "geometry/aabb.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kFineness = ", $fn = 0, $fa = 12, $fs = 2";

std::vector<TriangleMesh> meshes_in(const std::string& text) { return meshes_of(scene_of(text)); }

/// The volume of the meshes of a figure that is extruded with these arguments.
double extruded_volume(const std::string& arguments, const std::string& figure) {
  return mesh_volume(
      meshes_in("linear_extrude(height = 10, " + arguments + kFineness + ") " + figure));
}

Aabb bounds_of(const Scene& scene) {
  Aabb box = Aabb::nothing();
  for (const TriangleMesh& mesh : meshes_of(scene)) {
    for (const Vec3& p : mesh.points) box.include(p);
  }
  return box;
}

TEST_CASE(
    "edges towards the origin, whose diagonals are equal, are cut by the sense of the twist") {
  CHECK(extruded_volume("twist = -180", "polygon(points = [[0, 0], [3, 0], [0, 3]]);") ==
        Approx(56.53104));
  CHECK(extruded_volume("twist = -360, slices = 20", "square(size = [4, 1]);") == Approx(48.103));
  CHECK(extruded_volume("twist = 90", "square(size = [2, 2]);") == Approx(42.9966));
  CHECK(extruded_volume("twist = -90", "square(size = [2, 2]);") == Approx(42.9966));
}

TEST_CASE("a hole is cut by the opposite sense, and belongs to the mesh") {
  const auto meshes = meshes_in(
      "linear_extrude(height = 10, twist = 60, scale = [0.5, 1.5], slices = 6) polygon(points = "
      "[[-3, -3], [3, -3], [3, 3], [-3, 3], [0.5, 0], [2.5, 0], [2.5, 2], [0.5, 2]], "
      "paths = [[0, 1, 2, 3], [4, 5, 6, 7]]);");
  REQUIRE(meshes.size() == 1);
  CHECK(mesh_volume(meshes) == Approx(310.54807));
}

TEST_CASE("a figure that is scaled to a line ends in that line") {
  CHECK(extruded_volume("slices = 1, scale = [1, 0]",
                        "polygon(points = [[-15, 0], [0, -8], [15, 0], [0, 8]]);") == Approx(1600));
  CHECK(extruded_volume("scale = [1, 0]",
                        "polygon(points = [[-4, -3], [4, -3], [4, 3], [-4, 3], [-1, -1], [1, -1], "
                        "[1, 1], [-1, 1]], paths = [[0, 1, 2, 3], [4, 5, 6, 7]]);") == Approx(220));
  CHECK(extruded_volume("scale = 0", "square(size = [3, 3]);") == Approx(30));
}

TEST_CASE("with twist, uneven scale asks for no more slices: as in OpenSCAD 2021.01") {
  const auto meshes = meshes_in("linear_extrude(height = 10, scale = [2, 0.5], twist = 40" +
                                kFineness + ") square(size = [20, 10], center = true);");
  REQUIRE(meshes.size() == 1);
  CHECK(levels_of(meshes.front()) == 5);
}

TEST_CASE("an extrusion along v leans, its height measured along v") {
  const std::string figure = "polygon(points = [[0, 0], [2, 0], [1, 1], [2, 2], [0, 2]]);";
  const std::string sweep =
      "linear_extrude(height = 5.38516, v = [0.371391, 0, 0.928477], scale = 0.5" + kFineness +
      ") ";
  const Aabb box = bounds_of(scene_of(sweep + figure));
  CHECK(box.lo == Vec3{0, 0, 0});
  CHECK(box.hi.x == Approx(3));
  CHECK(box.hi.y == 2);
  CHECK(box.hi.z == Approx(5));
  const Scene upright = scene_of("linear_extrude(v = [0, 3, 4]) square(size = [1, 1]);");
  CHECK(volume(upright, {0, 0, 0}, {1, 4, 4}, 40) == 0);
  REQUIRE(upright.objects.size() == 1);
  const CsgNode& leaf = upright.objects[0].csg;
  REQUIRE(leaf.transform);
  CHECK(leaf.transform->point({0, 0, 4}) == Vec3{0, 3, 4});
  CHECK(std::get<PrismShape>(leaf.value).height == 4);
  CHECK(warnings_of("linear_extrude(v = [1, 2, 1e-308]) square(size = [1, 1]);").size() == 2);
  CHECK(warnings_of("linear_extrude(v = [1, 0, -1]) square(size = [1, 1]);").size() == 2);
}

TEST_CASE("a turn begins at its start, and without one where OpenSCAD 2021.01 begins") {
  const auto box_of = [](const std::string& arguments) {
    OpenscadOptions facets;
    facets.facets = true;
    return bounds_of(scene_of("rotate_extrude(" + arguments +
                                  ", $fn = 3) multmatrix([[1, 0, 0, 2]]) square(size = [1, 1]);",
                              facets));
  };
  const Aabb quarter = box_of("angle = 90, start = 90");
  CHECK(quarter.lo.x == Approx(-3));
  CHECK(std::fabs(quarter.hi.x) < 1e-12);
  CHECK(quarter.hi.y == Approx(3));
  CHECK(box_of("angle = 90").hi.x == Approx(3));
  // Three sides: the corner lies at the start.
  CHECK(box_of("angle = 360").lo.x == Approx(-3));
  CHECK(box_of("angle = 360, start = 0").hi.x == Approx(3));
  CHECK(box_of("angle = 360, start = 0").lo.x > -2);
}

TEST_CASE("a round turn begins at its start, too") {
  const Scene scene = scene_of(
      "rotate_extrude(angle = 90, start = 90) multmatrix([[1, 0, 0, 2]]) "
      "square(size = [1, 1]);");
  CHECK(any_object_holds(scene, {-1.7, 1.7, 0.5}));
  CHECK_FALSE(any_object_holds(scene, {1.7, 1.7, 0.5}));
}

TEST_CASE("a figure of more corners than a prism may have becomes a mesh of the same volume") {
  std::string points = "[0, 0], [100, 0], [100, 100], [0, 100]", paths = "[0, 1, 2, 3]";
  int count = 4;
  for (int i = 0; i < 33 * 33; ++i) {
    const int x = 3 * (i % 33) + 1, y = 3 * (i / 33) + 1;
    const auto corner = [&](int dx, int dy) {
      points += ", [" + std::to_string(x + dx) + ", " + std::to_string(y + dy) + "]";
    };
    corner(0, 0), corner(2, 0), corner(2, 2), corner(0, 2);
    paths += ", [" + std::to_string(count) + ", " + std::to_string(count + 1) + ", " +
             std::to_string(count + 2) + ", " + std::to_string(count + 3) + "]";
    count += 4;
  }
  const auto meshes = meshes_in("linear_extrude(height = 1) polygon(points = [" + points +
                                "], paths = [" + paths + "]);");
  REQUIRE(meshes.size() == 1);
  CHECK(mesh_volume(meshes) == Approx(10000 - 33 * 33 * 4));
}

TEST_CASE("arguments that aren't known are told once a kind") {
  const auto warnings = warnings_of(
      "linear_extrude(height = 1, segments = 4) square(size = [1, 1]);\n"
      "linear_extrude(height = 1, segments = 5) square(size = [1, 1], round = 2);");
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0] ==
        "line 1: linear_extrude(): the argument segments is not known, and ignored "
        "(and 1 more like it)");
  CHECK(warnings[1] == "line 2: square(): the argument round is not known, and ignored");
}

}  // namespace
}  // namespace graycube
