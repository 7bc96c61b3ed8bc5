// Makes solids of the meshes of a file.
#include "formats/mesh/close_parts.hpp"

#include "catch.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The faces from `first` up to `end` of a box.
MeshPart part_of_box(const std::string& name, double x, std::uint32_t first, std::uint32_t end) {
  const PolygonMesh box = box_polygons({x, 0, 0}, {x + 1, 2, 3});
  MeshPart part{name};
  part.polygons.points = box.points;
  for (std::uint32_t f = first; f < end; ++f)
    part.polygons.add_face(std::span(box.corners).subspan(4 * std::size_t{f}, 4));
  return part;
}
MeshPart box_part(const std::string& name, double x) { return part_of_box(name, x, 0, 6); }

MeshSolids solids_of(std::variant<MeshSolids, MeshFault> read) {
  if (const auto* fault = std::get_if<MeshFault>(&read)) FAIL(fault->why);
  return std::get<MeshSolids>(std::move(read));
}
std::string why(const std::variant<MeshSolids, MeshFault>& read) {
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}

}  // namespace

TEST_CASE("each closed mesh of a file is a solid, in order") {
  const auto read = solids_of(closed_parts({box_part("a", 0), box_part("b", 5)}, {}));
  REQUIRE(read.solids.size() == 2);
  CHECK(read.solids[0].name == "a");
  CHECK(read.solids[1].name == "b");
  CHECK(enclosed_volume(read.solids[1].shape.mesh) == Approx(6));
  CHECK(read.warnings.empty());
}

TEST_CASE("one open mesh of several is left out with a warning, the others are solids") {
  const auto read = solids_of(
      closed_parts({box_part("a", 0), part_of_box("lid", 5, 0, 4), part_of_box("", 9, 0, 5)}, {}));
  REQUIRE(read.solids.size() == 1);
  REQUIRE(read.warnings.size() == 1);
  CHECK(read.warnings[0].leaves_out);
  CHECK(read.warnings[0].where == "lid");
  CHECK(read.warnings[0].text.find("left out: not closed: the edge from (") == 0);
  CHECK(read.warnings[0].text.find("(and 1 more like it)") != std::string::npos);
}

TEST_CASE("meshes that continue each other at open edges are one solid") {
  const auto read =
      solids_of(closed_parts({part_of_box("red", 0, 0, 3), box_part("b", 5),
                              part_of_box("green", 0, 3, 6), part_of_box("open", 9, 0, 3)},
                             {}));
  REQUIRE(read.solids.size() == 2);
  CHECK(read.solids[0].name == "red");
  CHECK(enclosed_volume(read.solids[0].shape.mesh) == Approx(6));
  REQUIRE(read.warnings.size() == 1);
  CHECK(read.warnings[0].where == "open");
}

TEST_CASE("a mesh with every face both ways encloses nothing, unless faces may be dropped") {
  MeshPart both = box_part("both", 5);
  const PolygonMesh once = both.polygons;
  for (std::size_t f = 0; f < 6; ++f) {
    const auto face = std::span(once.corners).subspan(4 * f, 4);
    both.polygons.add_face(std::array{face[3], face[2], face[1], face[0]});
  }
  const auto read = solids_of(closed_parts({box_part("a", 0), both}, {}));
  REQUIRE(read.solids.size() == 1);
  REQUIRE(read.warnings.size() == 1);
  CHECK(read.warnings[0].leaves_out);
  CHECK(read.warnings[0].where == "both");
  CHECK(read.warnings[0].text == "left out: it encloses no volume");
  for (const OpenMeshes open : {OpenMeshes::kRepair, OpenMeshes::kDropExtraFaces}) {
    const auto mended = solids_of(closed_parts({both}, open));
    REQUIRE(mended.solids.size() == 1);
    CHECK(enclosed_volume(mended.solids[0].shape.mesh) == Approx(6));
    REQUIRE(mended.warnings.size() == 1);
    CHECK_FALSE(mended.warnings[0].leaves_out);
    CHECK_THAT(mended.warnings[0].text, Catch::StartsWith("repaired: dropped "));
  }
}

TEST_CASE("faces that are one too many are dropped where that is asked for, holes aren't filled") {
  MeshPart twice = box_part("a", 0);
  const std::vector<std::uint32_t> corners = twice.polygons.corners;
  twice.polygons.add_face(std::span(corners).first(4));
  CHECK(why(closed_parts({twice}, OpenMeshes::kLeaveOut)).find("not ") == 0);
  const auto read = solids_of(closed_parts({twice}, OpenMeshes::kDropExtraFaces));
  REQUIRE(read.solids.size() == 1);
  CHECK(enclosed_volume(read.solids[0].shape.mesh) == Approx(6));
  CHECK(why(closed_parts({part_of_box("a", 0, 0, 5)}, OpenMeshes::kDropExtraFaces))
            .find("not closed: ") == 0);
}

TEST_CASE("a file of open meshes only is refused with the first of them") {
  const auto two = closed_parts({part_of_box("a", 0, 0, 5), part_of_box("b", 5, 0, 5)}, {});
  CHECK(why(two).find("none of its 2 meshes is closed; a: not closed: the edge from") == 0);
  CHECK(std::get<MeshFault>(two).is_open);
  CHECK(why(closed_parts({part_of_box("a", 0, 0, 5)}, {})).find("not closed: ") == 0);
  CHECK(why(closed_parts({MeshPart{"points only"}}, {})) == "no face encloses anything");
}

TEST_CASE("open meshes are repaired when that is asked for, which is told once a kind") {
  const auto read = solids_of(closed_parts(
      {part_of_box("a", 0, 0, 5), part_of_box("b", 5, 1, 6), part_of_box("bent", 9, 0, 3)},
      OpenMeshes::kRepair));
  REQUIRE(read.solids.size() == 2);
  REQUIRE(read.warnings.size() == 2);
  CHECK(read.warnings[0].where == "bent");
  CHECK(read.warnings[0].leaves_out);
  CHECK(read.warnings[1] ==
        ImportWarning{"", "repaired: filled 2 flat holes of up to 4 edges", false});
}

TEST_CASE("parts of a body that is closed are one solid, and others solids of their own") {
  const auto body = solids_of(
      closed_body({part_of_box("a", 0, 0, 3), part_of_box("b", 0, 3, 6), box_part("c", 5)}, {}));
  REQUIRE(body.solids.size() == 1);
  CHECK(enclosed_volume(body.solids[0].shape.mesh) == Approx(12));
  const auto open = solids_of(closed_body({box_part("a", 0), part_of_box("b", 5, 0, 3)}, {}));
  CHECK(open.solids.size() == 1);
  CHECK(open.warnings.size() == 1);
}
