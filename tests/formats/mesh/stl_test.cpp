// STL files as programs write them.
#include "formats/mesh/stl.hpp"

#include <algorithm>

#include "catch.hpp"
#include "formats/mesh/stl_samples.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

TriangleMesh box() { return closed(box_polygons({0, 0, 0}, {2, 3, 1})); }

std::string why(const std::string& bytes) {
  const auto read = read_stl(bytes);
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}
/// The volume of what is read, if it is closed; the fault is told otherwise.
double volume(const std::string& bytes) {
  INFO(why(bytes));
  auto read = read_stl(bytes);
  REQUIRE(std::holds_alternative<std::vector<MeshPart>>(read));
  return enclosed_volume(closed(united(std::get<std::vector<MeshPart>>(read))));
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("an ASCII STL file is read in all the ways in which programs write it") {
  const std::string plain = stl_text(box());
  std::string upper = plain;
  std::ranges::transform(upper, upper.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  const std::vector<std::string> texts{
      plain,
      upper,
      "\xEF\xBB\xBF" + plain,
      "\n\n  " + plain,
      replaced(plain, "\n", "\r\n"),
      replaced(plain, "\n", "\r"),
      replaced(plain, " normal 0 0 0", ""),
      replaced(plain, " normal 0 0 0", " normal"),
      replaced(plain, "normal 0 0 0", "normal -nan(ind) nan nan"),
      replaced(plain, "outer loop", "outerloop"),
      replaced(plain, "endsolid box", "end solid box"),
      replaced(replaced(plain, "endloop", "end loop"), "endfacet", "end facet"),
      replaced(plain, "endsolid box\n", ""),
      replaced(plain, "solid box\n", ""),
      replaced(plain, "solid box", "solid"),
      replaced(plain, "endfacet\n", "endfacet\n; a comment facet\n"),
      replaced(plain, "outer loop\n", "outer loop # a comment\n// another vertex\n"),
      "; a comment first\n# and another\n" + plain,
      replaced(plain, "solid box\n", "solid box\ncolor 0.1 0.2 0.3\n"),
      replaced(plain, "\n", " "),
      plain + std::string(1, '\x1A') + std::string(5, '\0'),
      replaced(plain, "0.000000 0.000000 0.000000", "1e-400 -1e-999 +0"),
  };
  for (std::size_t i = 0; i < texts.size(); ++i) {
    INFO("text " << i);
    CHECK(volume(texts[i]) == Approx(6));
  }
}

TEST_CASE("a facet of more than three corners is a face of so many") {
  std::string text = "solid quads\n";
  const PolygonMesh quads = box_polygons({0, 0, 0}, {2, 3, 1});
  for (std::size_t i = 0; i < quads.corners.size(); ++i) {
    if (i % 4 == 0) text += "facet normal 0 0 0\nouter loop\n";
    const Vec3& p = quads.points[quads.corners[i]];
    text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
            std::to_string(p.z) + "\n";
    if (i % 4 == 3) text += "endloop\nendfacet\n";
  }
  CHECK(volume(text) == Approx(6));
}

TEST_CASE("each solid of an ASCII STL file is a part, wherever its lines end") {
  const TriangleMesh other = closed(box_polygons({5, 0, 0}, {6, 1, 1}));
  const std::string two = stl_text(box(), "a facet b") + stl_text(other, "lid\xFF");
  const auto read = read_stl(two);
  const auto& parts = std::get<std::vector<MeshPart>>(read);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "a facet b");
  CHECK(parts[1].name == "lid?");
  CHECK(parts[1].polygons.face_ends.size() == 12);
  CHECK(volume(replaced(two, "\n", " ")) == Approx(7));
}

TEST_CASE("a binary STL file holds as many facets as fit, whatever its header says") {
  for (const std::uint32_t announced : {12u, 0u, 11u, 13u, 0xFFFFFFFFu}) {
    INFO("announced " << announced);
    CHECK(volume(stl_bytes(box(), announced)) == Approx(6));
  }
  // Behind the facets there may be more.
  CHECK(volume(stl_bytes(box()) + "made by a program") == Approx(6));
  CHECK(volume(stl_bytes(box(), 0) + "xyz") == Approx(6));
}

TEST_CASE("a binary STL file that is cut off is told from one that says nothing") {
  std::string bytes = stl_bytes(box());
  bytes.resize(bytes.size() - 20);
  CHECK(why(bytes) == "binary STL with 12 facets announced and bytes for 11");
}

TEST_CASE("what is wrong with an STL file is said in words that are true") {
  CHECK(why("solid x\nface") == "line 2: expected \"facet\" or \"endsolid\", found \"face\"");
  CHECK(why("solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop") ==
        "line 6: expected a \"vertex\", found \"endloop\"");
  CHECK(why("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero") ==
        "line 4: expected a vertex's three numbers, found \"zero\"");
  CHECK(why("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e999").find("1e999") !=
        std::string::npos);
  CHECK(why("solid x\rfacet\router loop\rvertex").find("line 4: ") == 0);
  CHECK(why("solid x\nfacet\n").find("found the end of the file") != std::string::npos);
  CHECK(why("\xFF\xFEs\0o\0l\0i\0d\0").find("UTF-16") != std::string::npos);
  CHECK(why("\x1F\x8B...").find("gzip") != std::string::npos);
  CHECK(why(std::string(200, 'x')).find("a text that doesn't begin with \"solid\"") !=
        std::string::npos);
  CHECK(why("  \n").find("there is nothing in it") != std::string::npos);
}
