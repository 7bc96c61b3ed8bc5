// Drops faces that are one too many, as OpenSCAD does when it builds a solid face by face.
#include "formats/mesh/extra_faces.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "catch.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

using Face = std::vector<std::uint32_t>;

const PolygonMesh kBox = box_polygons({0, 0, 0}, {1, 2, 3});

std::vector<Face> faces_of(const PolygonMesh& mesh) {
  std::vector<Face> faces;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    faces.emplace_back(mesh.corners.begin() + begin, mesh.corners.begin() + end);
    begin = end;
  }
  return faces;
}
PolygonMesh mesh_of(const std::vector<Face>& faces, const std::vector<Vec3>& points = kBox.points) {
  PolygonMesh mesh;
  mesh.points = points;
  for (const Face& face : faces) mesh.add_face(face);
  return mesh;
}
Face turned(Face face) {
  std::reverse(face.begin(), face.end());
  return face;
}
/// The faces that are left; none where the mesh stays as it is.
std::vector<Face> left_of(const std::vector<Face>& faces) {
  const auto rest = without_extra_faces(mesh_of(faces), 0);
  return rest ? faces_of(*rest) : std::vector<Face>{};
}

}  // namespace

TEST_CASE("a face that is there three times counts once, wherever it begins") {
  const std::vector<Face> box = faces_of(kBox);
  for (const Face& face : box) {
    std::vector<Face> more = box;
    more.push_back(face);
    more.push_back({face[1], face[2], face[3], face[0]});
    CHECK(left_of(more) == box);
    // Half of a face goes along its edges, too.
    more.back() = {face[0], face[1], face[2]};
    CHECK(left_of(more) == box);
  }
}

TEST_CASE("a mesh that is a solid as it is stays, even if faces are there twice or back to back") {
  std::vector<Face> doubled;
  for (const Face& face : faces_of(kBox)) doubled.insert(doubled.end(), {face, face});
  CHECK(left_of(doubled).empty());
  // Two faces without an area come first and would surround the corners that others need.
  const std::vector<Face> faces{{0, 1, 2}, {2, 1, 0}, {2, 0, 4}, {0, 1, 4}, {0, 5, 1},
                                {0, 2, 5}, {2, 3, 5}, {4, 3, 2}, {1, 5, 3}, {4, 1, 3}};
  CHECK_FALSE(without_extra_faces(
      mesh_of(faces, {{0, 2, 0}, {0, 4, 0}, {0, 0, 0}, {0, 2, -4}, {2, 2, 0}, {-2, 2, 0}}), 0));
}

TEST_CASE("of two solids one may have both sides of every face") {
  std::vector<Face> faces = faces_of(kBox);
  std::vector<Vec3> points = kBox.points;
  for (const Vec3& p : kBox.points) points.push_back(p + Vec3{5, 0, 0});
  for (const Face& face : faces_of(kBox)) {
    Face moved;
    for (const std::uint32_t i : face) moved.push_back(i + 8);
    faces.push_back(moved);
  }
  for (std::size_t i = 6; i < 12; ++i) faces.push_back(turned(faces[i]));
  const auto rest = without_extra_faces(mesh_of(faces, points), 0);
  REQUIRE(rest);
  CHECK(enclosed_volume(closed(*rest)) == Approx(12));
}

TEST_CASE("corners that follow themselves are one") {
  std::vector<Face> faces = faces_of(kBox);
  const Face once = faces[0];
  faces[0] = {once[0], once[0], once[1], once[2], once[3], once[0]};
  const std::vector<Face> wanted = faces;
  faces.push_back(once);
  CHECK(left_of(faces) == wanted);
}

TEST_CASE("a face that is there both ways counts as its neighbours say, before them or after") {
  const std::vector<Face> box = faces_of(kBox);
  std::vector<Face> after = box, before = box;
  after.push_back(turned(box[2]));
  CHECK(left_of(after) == box);
  before.insert(before.begin(), turned(box[2]));
  const auto rest = without_extra_faces(mesh_of(before), 0);
  REQUIRE(rest);
  CHECK(rest->face_ends.size() == 6);
  const auto solid = closed_mesh(*rest);
  REQUIRE(std::holds_alternative<TriangleMesh>(solid));
  CHECK(enclosed_volume(std::get<TriangleMesh>(solid)) == Approx(6));
}

TEST_CASE("a face that closes a fan at a corner of other faces is dropped") {
  // OpenSCAD takes this octahedron: the third face, which is the second turned round, would make a
  // pillow of both, but the first touches them at point 0.
  const std::vector<Face> faces{{5, 3, 0}, {2, 0, 4}, {4, 0, 2}, {5, 1, 3}, {2, 5, 3}, {4, 1, 2},
                                {4, 0, 3}, {5, 0, 2}, {4, 3, 1}, {5, 2, 1}, {4, 2, 0}};
  const auto rest = without_extra_faces(
      mesh_of(faces, {{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}}), 0);
  REQUIRE(rest);
  CHECK(rest->face_ends.size() == 8);
}

TEST_CASE("of a surface of which each face is there both ways one side counts") {
  std::vector<Face> both = faces_of(kBox);
  for (const Face& face : faces_of(kBox)) both.push_back(turned(face));
  CHECK(left_of(both) == faces_of(kBox));
}

TEST_CASE("a wall between corners that are surrounded is dropped, an open sheet apart isn't") {
  std::vector<Face> faces = faces_of(kBox);
  // Its edges are diagonals of the box's sides.
  faces.push_back({0, 3, 5});
  faces.push_back(faces.front());
  CHECK(left_of(faces) == faces_of(kBox));
  std::vector<Vec3> points = kBox.points;
  points.insert(points.end(), {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
  faces[6] = {8, 9, 10};
  CHECK_FALSE(without_extra_faces(mesh_of(faces, points), 0));
}

TEST_CASE("corners that differ by rounding, or less than asked for, are one") {
  std::vector<Vec3> points = kBox.points;
  std::vector<Face> faces = faces_of(kBox);
  Face again;
  for (const std::uint32_t i : faces[1]) {
    again.push_back(static_cast<std::uint32_t>(points.size()));
    points.push_back(points[i] + Vec3{0, 1e-7, 0});
  }
  faces.push_back(again);
  CHECK_FALSE(without_extra_faces(mesh_of(faces, points), 0));
  const auto rest = without_extra_faces(mesh_of(faces, points), 1e-6);
  REQUIRE(rest);
  CHECK(faces_of(*rest) == faces_of(kBox));
}

TEST_CASE("meshes without extra faces stay, also where solids share an edge, and broken ones") {
  CHECK_FALSE(without_extra_faces(kBox, 0));
  PolygonMesh two = kBox;
  const PolygonMesh other = box_polygons({1, 2, 0}, {2, 3, 3});
  for (const Face& face : faces_of(other)) {
    Face moved;
    for (const std::uint32_t i : face) moved.push_back(i + 8);
    two.add_face(moved);
  }
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  CHECK_FALSE(without_extra_faces(two, 0));
  CHECK_FALSE(without_extra_faces(mesh_of({{0, 1, 99}, {0, 1, 99}}), 0));
  CHECK_FALSE(without_extra_faces(mesh_of({{0, 1}}), 0));
  CHECK_FALSE(without_extra_faces({}, 0));
}
