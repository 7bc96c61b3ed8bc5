// Repairs meshes that are nearly closed, and finds the holes of those that aren't.
#include "mesh/repair_mesh.hpp"

#include <random>

#include "catch.hpp"
#include "mesh/edges.hpp"
#include "mesh/holes.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The mesh without the faces whose numbers are given.
PolygonMesh without(const PolygonMesh& mesh, const std::vector<std::uint32_t>& dropped) {
  PolygonMesh out;
  out.points = mesh.points;
  std::uint32_t begin = 0;
  for (std::uint32_t f = 0; f < mesh.face_ends.size(); ++f) {
    const std::uint32_t end = mesh.face_ends[f];
    if (std::find(dropped.begin(), dropped.end(), f) == dropped.end())
      out.add_face(std::span(mesh.corners).subspan(begin, end - begin));
    begin = end;
  }
  return out;
}

/// Every face with corners of its own, off by up to `noise`.
PolygonMesh shaken(const PolygonMesh& mesh, double noise) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-noise, noise);
  PolygonMesh out;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    std::vector<std::uint32_t> face;
    for (; begin < end; ++begin) {
      face.push_back(static_cast<std::uint32_t>(out.points.size()));
      out.points.push_back(mesh.points[mesh.corners[begin]] +
                           Vec3{off(random), off(random), off(random)});
    }
    out.add_face(face);
  }
  return out;
}

/// An upright drum without its upper end: that is one hole of so many edges.
PolygonMesh open_drum(double radius, std::uint32_t sides) {
  const PolygonMesh drum = drum_polygons(radius, 0, 2, sides);
  PolygonMesh out;
  out.points = drum.points;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : drum.face_ends) {
    const auto face = std::span(drum.corners).subspan(begin, end - begin);
    if (end - begin == 4 || face[0] < sides) out.add_face(face);
    begin = end;
  }
  return out;
}

RepairedMesh repaired(const PolygonMesh& mesh) {
  auto result = repaired_mesh(mesh);
  if (const auto* fault = std::get_if<MeshFault>(&result)) FAIL(fault->why);
  CHECK(MeshEdges(std::get<RepairedMesh>(result).mesh.triangles).unbalanced_count() == 0);
  return std::get<RepairedMesh>(std::move(result));
}
std::string refusal(const PolygonMesh& mesh) {
  const auto result = repaired_mesh(mesh);
  const auto* fault = std::get_if<MeshFault>(&result);
  return fault == nullptr ? "" : fault->why;
}
bool contains_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a closed mesh is not repaired") {
  const PolygonMesh ring = ring_polygons(3, 1, 9, 7);
  const RepairedMesh r = repaired(ring);
  CHECK(r.mesh == closed(ring));
  CHECK(r.repairs.joined_corners + r.repairs.filled_holes + r.repairs.dropped_faces == 0);
}

TEST_CASE("corners within the tolerance are joined, no farther than needed") {
  const PolygonMesh ring = ring_polygons(3, 1, 9, 7);
  for (const double noise : {1e-10, 1e-7, 1e-5, 1e-4}) {
    INFO("noise " << noise);
    const RepairedMesh r = repaired(shaken(ring, noise));
    CHECK(r.mesh.points.size() == 63);
    CHECK(r.repairs.joined_corners == 4 * 63 - 63);
    CHECK(r.repairs.farthest_joined > 0);
    CHECK(r.repairs.farthest_joined <= 2 * noise);
    CHECK(r.repairs.filled_holes == 0);
    CHECK(enclosed_volume(r.mesh) == Approx(enclosed_volume(closed(ring))).epsilon(1e-3));
  }
  CHECK(contains_text(refusal(shaken(ring, 0.05)), "not closed even when repaired"));
}

TEST_CASE("a missing face is filled") {
  const PolygonMesh box = box_polygons({0, 0, 0}, {1, 2, 3});
  for (std::uint32_t f = 0; f < 6; ++f) {
    const RepairedMesh r = repaired(without(box, {f}));
    CHECK(enclosed_volume(r.mesh) == Approx(6));
    CHECK(r.repairs.filled_holes == 1);
    CHECK(r.repairs.most_filled_edges == 4);
  }
  CHECK(repaired(without(box, {0, 1})).repairs.filled_holes == 2);
}

TEST_CASE("holes of up to 64 edges are filled, larger ones are named") {
  const RepairedMesh r = repaired(open_drum(1, 64));
  CHECK(r.repairs.most_filled_edges == 64);
  CHECK(enclosed_volume(r.mesh) == Approx(enclosed_volume(closed(drum_polygons(1, 0, 2, 64)))));
  const std::string why = refusal(open_drum(1, 65));
  CHECK(contains_text(why, "1 hole is left, one of 65 edges at ("));
  CHECK(contains_text(why, "up to 64 edges"));
}

TEST_CASE("a ring of a hole is filled by what is around it less what is in it") {
  PolygonMesh tube = open_drum(2, 20);
  append(tube, open_drum(1, 12), true);
  // Both have their lower end; without it the hole of the inner one is a pit.
  const RepairedMesh r = repaired(tube);
  CHECK(r.repairs.filled_holes == 2);
  const double outer = enclosed_volume(closed(drum_polygons(2, 0, 2, 20)));
  const double inner = enclosed_volume(closed(drum_polygons(1, 0, 2, 12)));
  CHECK(enclosed_volume(r.mesh) == Approx(outer - inner));
}

TEST_CASE("a bent hole is left, and where it is") {
  const std::string why = refusal(without(box_polygons({0, 0, 0}, {1, 2, 3}), {0, 2}));
  CHECK(contains_text(why, "one of 6 edges at ("));
  CHECK(contains_text(why, "only flat holes are filled"));
}

TEST_CASE("an edge that is cut on one side only is closed") {
  PolygonMesh box = box_polygons({0, 0, 0}, {1, 2, 3});
  box.points.push_back({0.5, 0, 0});
  PolygonMesh cut = without(box, {0});
  cut.add_face(std::array{0u, 2u, 3u, 1u, 8u});
  const RepairedMesh r = repaired(cut);
  CHECK(enclosed_volume(r.mesh) == Approx(6));
  CHECK(r.repairs.most_filled_edges == 3);
}

TEST_CASE("a face that is there twice is dropped once") {
  PolygonMesh box = box_polygons({0, 0, 0}, {1, 2, 3});
  box.add_face(std::array{3u, 1u, 0u, 2u});
  const RepairedMesh r = repaired(box);
  CHECK(enclosed_volume(r.mesh) == Approx(6));
  CHECK(r.repairs.dropped_faces + r.repairs.filled_holes > 0);
  PolygonMesh triangles;
  const TriangleMesh once = closed(box_polygons({0, 0, 0}, {1, 2, 3}));
  triangles.points = once.points;
  for (const Triangle& t : once.triangles) triangles.add_face(t);
  const Triangle& again = once.triangles[5];
  triangles.add_face(std::array{again[1], again[2], again[0]});
  const RepairedMesh s = repaired(triangles);
  CHECK(s.repairs.dropped_faces == 1);
  CHECK(s.mesh == once);
}

TEST_CASE("of faces that are there both ways one side is dropped, unless they are a wall") {
  const TriangleMesh once = closed(box_polygons({0, 0, 0}, {1, 2, 3}));
  const auto with_turned = [&](std::size_t from, std::size_t count) {
    PolygonMesh mesh;
    mesh.points = once.points;
    for (const Triangle& t : once.triangles) mesh.add_face(t);
    for (std::size_t i = from; i < from + count; ++i) {
      const auto& [a, b, c] = once.triangles[i];
      mesh.add_face(std::array{c, b, a});
    }
    return mesh;
  };
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, once.triangles.size()}) {
    const RepairedMesh r = repaired(with_turned(0, count));
    CHECK(r.repairs.dropped_faces == count);
    CHECK(r.repairs.filled_holes == 0);
    CHECK(enclosed_volume(r.mesh) == Approx(6));
  }
  // A wall across the inside stays; what is mended is the hole.
  PolygonMesh walled = without(with_turned(0, 0), {3});
  walled.points.push_back({0.5, 0.5, 0.5});
  walled.points.push_back({0.5, 1, 0.5});
  walled.points.push_back({0.5, 0.5, 1});
  walled.add_face(std::array{8u, 9u, 10u});
  walled.add_face(std::array{10u, 9u, 8u});
  const RepairedMesh w = repaired(walled);
  CHECK(w.repairs.dropped_faces == 0);
  CHECK(w.repairs.filled_holes == 1);
  CHECK(enclosed_volume(w.mesh) == Approx(6));
}

TEST_CASE("a strip that goes on beyond its seam is dropped") {
  PolygonMesh drum = drum_polygons(1, 0, 2, 16);
  // Once more the side that begins at the seam, off by what 16 sums of an angle may be.
  const auto side = [&] {
    std::uint32_t begin = 0;
    for (const std::uint32_t end : drum.face_ends) {
      if (end - begin == 4) break;
      begin = end;
    }
    return std::vector<std::uint32_t>(drum.corners.begin() + begin,
                                      drum.corners.begin() + begin + 4);
  }();
  std::vector<std::uint32_t> again;
  for (const std::uint32_t i : side) {
    again.push_back(static_cast<std::uint32_t>(drum.points.size()));
    drum.points.push_back(drum.points[i] + Vec3{-3e-6, 2e-6, 0});
  }
  drum.add_face(again);
  REQUIRE(std::holds_alternative<MeshFault>(closed_mesh(drum)));
  const auto repaired = repaired_mesh(drum);
  REQUIRE(std::holds_alternative<RepairedMesh>(repaired));
  const auto& [mesh, repairs] = std::get<RepairedMesh>(repaired);
  CHECK(mesh.points.size() == 32);
  CHECK(repairs.dropped_faces == 2);
  CHECK(repairs.filled_holes == 0);
}

TEST_CASE("a sheet is no solid, however it is repaired") {
  PolygonMesh sheet;
  sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.add_face(std::array{0u, 1u, 2u, 3u});
  CHECK(contains_text(refusal(sheet), "encloses no volume"));
}

TEST_CASE("holes that meet at a corner are holes of their own") {
  PolygonMesh ball = ball_polygons(1, 4, 8);
  const TriangleMesh mesh = std::get<TriangleMesh>(welded_mesh(ball));
  TriangleMesh open = mesh;
  // The first is at the pole; so is that three meridians on.
  std::vector<Triangle> kept;
  int at_pole = 0;
  for (const Triangle& t : mesh.triangles) {
    const bool is_polar = mesh.points[t[0]].z == 1;
    if (is_polar && (at_pole++ == 0 || at_pole == 4)) continue;
    kept.push_back(t);
  }
  const auto holes = holes_of(kept, open.points.size());
  REQUIRE(holes.size() == 2);
  CHECK(holes[0].size() == 3);
  CHECK(holes[1].size() == 3);
}
