// Turns polygons into closed meshes.
#include "mesh/close_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "catch.hpp"
#include "mesh/cut_face.hpp"
#include "mesh/face_limits.hpp"
#include "mesh/samples.hpp"
#include "written_digits.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

double volume_of(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c]));
  return sum / 6;
}

/// Areas along z of the triangles that a face in the x-y plane is cut into.
std::vector<double> cut_areas(const std::vector<Vec3>& corners) {
  std::vector<std::uint32_t> face(corners.size());
  for (std::uint32_t i = 0; i < face.size(); ++i) face[i] = i;
  std::vector<Triangle> triangles;
  cut_face(corners, face, FaceSide::kOuter, triangles);
  std::vector<double> areas;
  for (const auto& [a, b, c] : triangles) {
    areas.push_back(0.5 * cross(corners[b] - corners[a], corners[c] - corners[a]).z);
  }
  return areas;
}

bool contains_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a box of six squares is a mesh of twelve triangles and eight points") {
  const TriangleMesh mesh = closed(box_polygons({0, 0, 0}, {1, 2, 3}));
  CHECK(mesh.points.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(volume_of(mesh) == Approx(6));
}

TEST_CASE("a mesh turned inside out is turned back as a whole, cavities kept") {
  PolygonMesh turned;
  append(turned, box_polygons({0, 0, 0}, {1, 2, 3}), true);
  CHECK(volume_of(closed(turned)) == Approx(6));
  PolygonMesh hollow = box_polygons({0, 0, 0}, {4, 4, 4});
  append(hollow, box_polygons({1, 1, 1}, {2, 2, 2}), true);
  CHECK(volume_of(closed(hollow)) == Approx(63));
}

TEST_CASE("a far corner of a face without area doesn't matter for which side is outside") {
  PolygonMesh turned;
  append(turned, box_polygons({0, 0, 0}, {1, 2, 3}), true);
  turned.points.push_back({-1e200, 0, 0});
  turned.add_face(std::array{8u, 8u, 0u});
  turned.add_face(std::array{8u, 0u, 8u, 0u});
  const TriangleMesh mesh = closed(turned);
  CHECK(mesh.points.size() == 8);
  CHECK(volume_of(mesh) == Approx(6));
}

TEST_CASE("closing a closed mesh changes nothing") {
  PolygonMesh turned;
  append(turned, ring_polygons(3, 1, 7, 5), true);
  const TriangleMesh once = closed(turned);
  CHECK(std::get<TriangleMesh>(closed_mesh(once)) == once);
  PolygonMesh again;
  again.points = once.points;
  for (const Triangle& t : once.triangles) again.add_face(t);
  CHECK(closed(again) == once);
}

TEST_CASE("points with equal coordinates are one, and unused ones are dropped") {
  PolygonMesh soup;
  const PolygonMesh box = box_polygons({-1, -1, -1}, {0, 0, 0});
  soup.points.push_back({9, 9, 9});
  for (const std::uint32_t i : box.corners)
    soup.points.push_back(0.0 == box.points[i].x ? box.points[i] + Vec3{-0.0, 0, 0}
                                                 : box.points[i]);
  for (std::uint32_t f = 0; f < 6; ++f) {
    const std::uint32_t n = 1 + 4 * f;
    soup.add_face(std::array{n, n + 1, n + 2, n + 3});
  }
  CHECK(closed(soup).points.size() == 8);
}

TEST_CASE("negative zeros weld with zeros") {
  PolygonMesh mesh = box_polygons({0, 0, 0}, {1, 1, 1});
  mesh.points.push_back({-0.0, -0.0, -0.0});
  mesh.corners[0] = 8;
  CHECK(closed(mesh).points.size() == 8);
}

TEST_CASE("faces that disagree are turned to agree with their neighbours") {
  const PolygonMesh ring = ring_polygons(3, 1, 8, 6);
  PolygonMesh mixed;
  mixed.points = ring.points;
  for (std::uint32_t f = 0; f < ring.face_ends.size(); ++f) {
    std::array<std::uint32_t, 4> face{};
    for (std::uint32_t i = 0; i < 4; ++i) face[i] = ring.corners[4 * f + (f % 3 == 0 ? 3 - i : i)];
    mixed.add_face(face);
  }
  CHECK(volume_of(closed(mixed)) == Approx(volume_of(closed(ring))));
}

TEST_CASE("an open mesh is refused with its first open edge") {
  PolygonMesh open = box_polygons({0, 0, 0}, {1, 1, 1});
  open.corners.resize(20);
  open.face_ends.resize(5);
  const std::string why = fault_of(open);
  CHECK(contains_text(why, "not closed"));
  CHECK(contains_text(why, "the edge from (1, 1, 0) to (1, 0, 0)"));
  CHECK(contains_text(why, "4 edges"));
}

TEST_CASE("a surface with one side is refused") {
  // A projective plane of six points: every edge has two faces, and no orientation.
  PolygonMesh plane;
  for (int i = 0; i < 6; ++i) plane.points.push_back({1.0 * i, 1.0 * i * i, 1.0 * i * i * i});
  constexpr std::uint32_t kFaces[10][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                           {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  for (const auto& f : kFaces) plane.add_face(f);
  CHECK(contains_text(fault_of(plane), "no inside"));
}

TEST_CASE("two boxes that share an edge are one closed mesh") {
  PolygonMesh two = box_polygons({0, 0, 0}, {1, 1, 1});
  append(two, box_polygons({1, 1, 0}, {2, 2, 1}));
  CHECK(closed(two).points.size() == 14);
}

TEST_CASE("faces, points and corners out of range are refused") {
  PolygonMesh mesh = box_polygons({0, 0, 0}, {1, 1, 1});
  SECTION("a point that isn't there") {
    mesh.corners[5] = 8;
    CHECK(contains_text(fault_of(mesh), "face 1 has the point 8, there are 8"));
  }
  SECTION("a point at infinity") {
    mesh.points[3].y = INFINITY;
    CHECK(contains_text(fault_of(mesh), "point 3 is not finite"));
  }
  SECTION("too few corners") {
    mesh.add_face(std::array{0u, 1u});
    CHECK(contains_text(fault_of(mesh), "face 6 has 2 corners"));
  }
  SECTION("too many corners") {
    mesh.add_face(std::vector<std::uint32_t>(kMostFaceCorners + 1, 0u));
    CHECK(contains_text(fault_of(mesh), "corners, at most 131072"));
  }
  SECTION("no face at all") {
    CHECK(contains_text(fault_of({mesh.points, {}, {}}), "no face encloses anything"));
  }
}

TEST_CASE("convex and concave faces are cut into triangles of one sense") {
  const std::vector<std::vector<Vec3>> faces{
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}},
      {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 2, 0}, {3, 2, 0}, {3, 3, 0}, {0, 3, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}};
  const double areas[] = {2, 10, 7, 4};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    double sum = 0;
    const auto cut = cut_areas(faces[f]);
    CHECK(cut.size() == faces[f].size() - 2);
    for (const double a : cut) {
      CHECK(a > 0);
      sum += a;
    }
    CHECK(sum == Approx(areas[f]));
  }
}

TEST_CASE("a face that crosses itself or is bent leaves the mesh closed") {
  PolygonMesh bow;
  bow.points = {{0, 0, 0}, {2, 2, 1}, {2, 0, 0}, {0, 2, -1}, {0.3, 1, 5}, {1, 0.2, -3}};
  const std::array<std::uint32_t, 6> face{0, 1, 2, 3, 4, 5};
  const std::array<std::uint32_t, 6> back{5, 4, 3, 2, 1, 0};
  bow.add_face(face);
  bow.add_face(back);
  CHECK(fault_of(bow).empty());
}

TEST_CASE("bent faces are cut along the Delaunay diagonal of the face as seen along an axis") {
  // A kite whose ends are raised: only the short diagonal is Delaunay, whichever corner is first.
  const std::vector<Vec3> kite{{-3, 0, 0.5}, {0, -1, 0}, {3, 0, 0.5}, {0, 1, 0}};
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    std::vector<std::uint32_t> face;
    for (std::uint32_t i = 0; i < 4; ++i) face.push_back((turn + i) % 4);
    std::vector<Triangle> triangles;
    cut_face(kite, face, FaceSide::kOuter, triangles);
    REQUIRE(triangles.size() == 2);
    for (const Triangle& t : triangles) {
      const std::set<std::uint32_t> corners(t.begin(), t.end());
      CHECK(corners.count(1) + corners.count(3) == 2);
    }
  }
}

/// Where a bent face of four corners is cut, by all numberings of its corners.
std::set<std::set<std::uint32_t>> diagonals(const std::vector<Vec3>& corners, FaceSide side) {
  std::set<std::set<std::uint32_t>> found;
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    std::vector<std::uint32_t> face;
    for (std::uint32_t i = 0; i < 4; ++i) face.push_back((turn + i) % 4);
    std::vector<Triangle> triangles;
    cut_face(corners, face, side, triangles);
    REQUIRE(triangles.size() == 2);
    std::set<std::uint32_t> both;
    for (const std::uint32_t i : triangles[0]) {
      if (std::count(triangles[1].begin(), triangles[1].end(), i) > 0) both.insert(i);
    }
    found.insert(both);
  }
  return found;
}

TEST_CASE("bent faces with their corners on a circle are cut where OpenSCAD cuts them") {
  using Diagonals = std::set<std::set<std::uint32_t>>;
  const std::vector<Vec3> square{{0, 0, 0.2}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(diagonals(square, FaceSide::kOuter) == Diagonals{{1, 3}});
  CHECK(diagonals(square, FaceSide::kInner) == Diagonals{{0, 2}});
  const std::vector<Vec3> trapezoid{{-2, 0, 0}, {2, 0, 0}, {1, 1, 0.2}, {-1, 1, 0}};
  CHECK(diagonals(trapezoid, FaceSide::kOuter) == Diagonals{{1, 3}});
  CHECK(diagonals(trapezoid, FaceSide::kInner) == Diagonals{{1, 3}});
  // The angles at the corners 0 and 2 are 180.3 degrees together.
  const std::vector<Vec3> nearly{{0, 0, 0.2}, {1, 0, 0}, {0.9975, 0.9975, 0}, {0, 1, 0}};
  CHECK(diagonals(nearly, FaceSide::kOuter) == Diagonals{{1, 3}});
  const std::vector<Vec3> clearly{{0, 0, 0.2}, {1, 0, 0}, {0.9, 0.9, 0}, {0, 1, 0}};
  CHECK(diagonals(clearly, FaceSide::kOuter) == Diagonals{{0, 2}});
}

TEST_CASE("a flat face of 100 000 corners is cut without overlaps") {
  // A comb whose teeth are of different lengths.
  std::vector<Vec3> comb{{0, 0, 0}, {50000, 0, 0}};
  double area = 50000 * 5.0;
  for (int i = 24999; i >= 0; --i) {
    const double x = 2.0 * i, top = 10 + i * 37 % 101;
    for (const auto& [dx, y] : {std::pair{1.5, top}, {0.5, top}, {0.5, 5.0}})
      comb.push_back({x + dx, y, 0});
    if (i > 0) comb.push_back({x - 0.5, 5, 0});
    area += top - 5;
  }
  comb.insert(comb.begin() + 2, {50000, 5, 0});
  comb.insert(comb.begin() + 3, {49999.5, 5, 0});
  comb.push_back({0, 5, 0});
  const auto areas = cut_areas(comb);
  REQUIRE(areas.size() == comb.size() - 2);
  double sum = 0;
  for (const double a : areas) sum += std::fabs(a);
  CHECK(sum == Approx(area));
}

TEST_CASE("a bent fan of many corners has no corner within the circle of a triangle") {
  std::vector<Vec3> rim;
  std::vector<std::uint32_t> face;
  for (std::uint32_t i = 0; i < 16; ++i) {
    // On an ellipse, so that few diagonals are Delaunay.
    const double angle = 2 * 3.141592653589793 * i / 16;
    rim.push_back({4 * std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.3 : 0});
    face.push_back(i);
  }
  std::vector<Triangle> triangles;
  cut_face(rim, face, FaceSide::kOuter, triangles);
  REQUIRE(triangles.size() == 14);
  for (const auto& [a, b, c] : triangles) {
    for (std::uint32_t d = 0; d < 16; ++d) {
      const auto row = [&](std::uint32_t i) {
        const double x = rim[i].x - rim[d].x, y = rim[i].y - rim[d].y;
        return Vec3{x, y, x * x + y * y};
      };
      CHECK(dot(row(a), cross(row(b), row(c))) < 1e-9);
    }
  }
}

TEST_CASE("corners further apart are joined only within a distance that is asked for") {
  PolygonMesh gap = box_polygons({0, 0, 0}, {1, 1, 1});
  gap.points.push_back({1e-7, 0, 0});
  gap.corners[0] = 8;
  CHECK(contains_text(fault_of(gap), "not closed"));
  CHECK(std::holds_alternative<TriangleMesh>(closed_mesh(gap, 1e-6)));
  CHECK(std::holds_alternative<MeshFault>(closed_mesh(gap, 1e-8)));
}

TEST_CASE("corners that differ by a unit of the file's last digit are joined") {
  PolygonMesh seam = box_polygons({-2, -2, -2}, {2, 2, 2});
  // What the sine of 2π is in numbers of 24 bits, as a cylinder's seam has it.
  seam.points.push_back(seam.points[seam.corners[0]] + Vec3{0, -1.75e-7, 0});
  seam.corners[0] = 8;
  CHECK(contains_text(fault_of(seam), "not closed"));
  seam.digits = kSinglePrecisionDigits;
  const auto closed = closed_mesh(seam);
  REQUIRE(std::holds_alternative<TriangleMesh>(closed));
  CHECK(std::get<TriangleMesh>(closed).points.size() == 8);
  seam.points[8].y -= 1e-5;
  CHECK(contains_text(fault_of(seam), "not closed"));
}
