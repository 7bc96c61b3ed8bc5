#include "formats/openscad/hulls/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "catch.hpp"
#include "geometry/affine.hpp"

namespace graycube {
namespace {

ScadMesh cube_mesh() {
  ScadMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back(
        {(i & 1) != 0 ? 3.0 : 1.0, (i & 2) != 0 ? 7.0 : 4.0, (i & 4) != 0 ? 9.0 : -2.0});
  }
  mesh.faces = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  return mesh;
}

bool has_plane(const ConvexPlanes& convex, const Vec3& normal, double offset) {
  for (const HalfSpaceShape& plane : convex.planes) {
    if (plane.normal == normal && plane.offset == offset) return true;
  }
  return false;
}

double distance_outside(const ConvexPlanes& convex, const Vec3& p) {
  double largest = -INFINITY;
  for (const HalfSpaceShape& plane : convex.planes) {
    largest = std::max(largest, dot(plane.normal, p) - plane.offset);
  }
  return largest;
}

Vec3 rounded_to_six_digits(const Vec3& p) {
  Vec3 result;
  for (int a = 0; a < 3; ++a) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", p[a]);
    result[a] = std::strtod(text, nullptr);
  }
  return result;
}

TEST_CASE("the planes of a box are exact, whichever way its faces turn") {
  ScadMesh mesh = cube_mesh();
  for (int turn = 0; turn < 2; ++turn) {
    const ConvexPlanes convex = convex_planes(mesh);
    REQUIRE(convex.problem.empty());
    REQUIRE(convex.planes.size() == 6);
    CHECK(has_plane(convex, {1, 0, 0}, 3));
    CHECK(has_plane(convex, {-1, 0, 0}, -1));
    CHECK(has_plane(convex, {0, 1, 0}, 7));
    CHECK(has_plane(convex, {0, -1, 0}, -4));
    CHECK(has_plane(convex, {0, 0, 1}, 9));
    CHECK(has_plane(convex, {0, 0, -1}, 2));
    for (auto& face : mesh.faces) std::reverse(face.begin(), face.end());
  }
}

TEST_CASE("coplanar triangles become one plane") {
  ScadMesh mesh = cube_mesh();
  ScadMesh triangles{mesh.points, {}};
  for (const auto& f : mesh.faces) {
    triangles.faces.push_back({f[0], f[1], f[2]});
    triangles.faces.push_back({f[0], f[3], f[2]});
  }
  CHECK(convex_planes(triangles).planes.size() == 6);
}

TEST_CASE("points with equal coordinates are joined before the mesh is looked at") {
  const ScadMesh mesh = cube_mesh();
  ScadMesh split;
  for (const auto& face : mesh.faces) {
    split.faces.emplace_back();
    for (const auto corner : face) {
      split.faces.back().push_back(static_cast<std::uint32_t>(split.points.size()));
      split.points.push_back(mesh.points[corner]);
    }
  }
  CHECK(convex_planes(split).planes.size() == 6);
}

TEST_CASE("a mesh with a hole, an extra face or a dent is a problem, a flat one is empty") {
  ScadMesh open = cube_mesh();
  open.faces.pop_back();
  CHECK_THAT(convex_planes(open).problem,
             Catch::StartsWith("is not closed: the edge from point 1 to point "));

  ScadMesh doubled = cube_mesh();
  doubled.faces.push_back(doubled.faces[0]);
  CHECK_THAT(convex_planes(doubled).problem, Catch::Contains("belongs to 3 face(s), not 2"));

  ScadMesh dented = cube_mesh();
  dented.points.push_back({2, 5, 8});
  dented.faces[1] = {4, 5, 8};
  dented.faces.insert(dented.faces.end(), {{5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
  CHECK_THAT(convex_planes(dented).problem, Catch::StartsWith("is not convex"));
  dented.points[8].z = 10;
  CHECK(convex_planes(dented).planes.size() == 9);

  ScadMesh warped = cube_mesh();
  warped.points[7].z = 8;
  CHECK_THAT(convex_planes(warped).problem, Catch::StartsWith("has a face that is not flat"));

  ScadMesh flat = cube_mesh();
  for (Vec3& p : flat.points) p.z = 1;
  CHECK(convex_planes(flat).flat);
  CHECK(convex_planes({}).flat);
}

TEST_CASE("a thin plate is not taken for a flat mesh") {
  ScadMesh plate = cube_mesh();
  for (Vec3& p : plate.points) p = {100 * p.x, 100 * p.y, p.z > 0 ? 0.0005 : 0};
  CHECK(convex_planes(plate).planes.size() == 6);
}

TEST_CASE("turned solids written with six digits keep their planes, and no corner is cut off") {
  const std::uint32_t seed = 20240607;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> between(-1, 1);
  for (int round = 0; round < 120; ++round) {
    const int sides = 3 + round % 30;
    ScadMesh mesh =
        round % 2 == 0 ? faceted_cylinder(-1, 2, 3, 1, sides) : faceted_sphere(2, sides);
    const Affine turn = rotation({between(random), between(random), 1.1}, 360 * between(random));
    const Vec3 shift{50 * between(random), 50 * between(random), 0};
    for (Vec3& p : mesh.points) p = rounded_to_six_digits(turn.point(p) + shift);
    const ConvexPlanes convex = convex_planes(mesh);
    INFO("seed " << seed << ", round " << round << ", sides " << sides << ": " << convex.problem);
    REQUIRE(convex.problem.empty());
    const auto n = static_cast<std::size_t>(sides);
    CHECK(convex.planes.size() == (round % 2 == 0 ? n + 2 : n * ((n + 1) / 2 - 1) + 2));
    double cut_off = 0;
    for (const Vec3& p : mesh.points) cut_off = std::max(cut_off, distance_outside(convex, p));
    CHECK(cut_off <= 1e-12);
    CHECK(distance_outside(convex, turn.point({0, 0, 0}) + shift) < -0.5);
  }
}

TEST_CASE("few-sided solids have OpenSCAD's corners") {
  const ScadMesh prism = faceted_cylinder(0, 2, 1, 1, 4);
  CHECK(prism.points[0] == Vec3{1, 0, 0});
  CHECK(prism.points[1] == Vec3{0, 1, 0});
  CHECK(prism.points[6] == Vec3{-1, 0, 2});
  const ScadMesh ball = faceted_sphere(2, 6);
  REQUIRE(ball.points.size() == 18);
  CHECK(ball.points[0].x == Approx(1));
  CHECK(ball.points[0].z == Approx(std::sqrt(3.0)));
  CHECK(ball.points[6].x == Approx(2));
  CHECK(ball.points[6].z == 0);
}

}  // namespace
}  // namespace graycube
