// OFF files as programs write them.
#include "formats/mesh/off.hpp"

#include <bit>
#include <cstdint>
#include <string>

#include "catch.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// How a file is written.
struct Style {
  std::string header = "OFF", behind_point{}, behind_face{}, line_end = "\n";
};

std::string off_text(const PolygonMesh& mesh, const Style& style) {
  std::string text = style.header + style.line_end + std::to_string(mesh.points.size()) + " " +
                     std::to_string(mesh.face_ends.size()) + " 0" + style.line_end;
  for (const Vec3& p : mesh.points) {
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) +
            style.behind_point + style.line_end;
  }
  for (std::size_t f = 0; f < mesh.face_ends.size(); ++f) {
    text += "4";
    for (std::size_t i = 0; i < 4; ++i) text += " " + std::to_string(mesh.corners[4 * f + i]);
    text += style.behind_face + style.line_end;
  }
  return text;
}

std::string why(const std::string& bytes) {
  const auto read = read_off(bytes);
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}
double volume(const std::string& bytes) {
  INFO(why(bytes));
  const auto read = read_off(bytes);
  REQUIRE(std::holds_alternative<PolygonMesh>(read));
  return enclosed_volume(closed(std::get<PolygonMesh>(read)));
}

PolygonMesh box() { return box_polygons({0, 0, 0}, {2, 3, 1}); }

/// A binary file; `extras` numbers follow the coordinates of each point.
std::string off_bytes(const PolygonMesh& mesh, const std::string& header, bool has_fourth,
                      std::size_t extras, std::uint32_t colors) {
  std::string bytes = header;
  const auto put = [&](std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> shift & 0xFF);
  };
  const auto put_number = [&](double v) {
    put(std::bit_cast<std::uint32_t>(static_cast<float>(v)));
  };
  put(static_cast<std::uint32_t>(mesh.points.size()));
  put(static_cast<std::uint32_t>(mesh.face_ends.size()));
  put(0);
  for (const Vec3& p : mesh.points) {
    const double w = has_fourth ? 0.5 : 1;
    for (int a = 0; a < 3; ++a) put_number(w * p[a]);
    if (has_fourth) put_number(w);
    for (std::size_t i = 0; i < extras; ++i) put_number(7);
  }
  for (std::size_t f = 0; f < mesh.face_ends.size(); ++f) {
    put(4);
    for (std::size_t i = 0; i < 4; ++i) put(mesh.corners[4 * f + i]);
    put(colors);
    for (std::uint32_t i = 0; i < colors; ++i) put_number(0.5);
  }
  return bytes;
}

}  // namespace

TEST_CASE("an OFF file is read with any header, and with what points and faces have beside") {
  const std::vector<Style> styles{
      {"OFF"},
      {"off"},
      {"COFF", " 255 0 0 255"},
      {"COFF", " 255 0 0"},
      {"coff", " 0.1 0.2 0.3 1"},
      {"NOFF", " 0 0 1"},
      {"CNOFF", " 0 0 1 255 0 0 255"},
      {"STOFF", " 0.5 0.5"},
      {"STCNOFF", " 0 0 1 255 0 0 255 0.5 0.5"},
      {"NCSTOFF", " 0 0 1 255 0 0 255 0.5 0.5"},
      {"4OFF", " 1"},
      {"C4OFF", " 1 255 0 0 255"},
      {"nOFF\n3"},
      {"OFF", " 255 0 0"},
      {"OFF", " # a comment"},
      {"OFF", "", " 3 255 0 0"},
      {"OFF", " 255 0 0", " 1.0 0.5 0.5 1.0"},
      {"# a comment\n\nOFF # another"},
      {"\xEF\xBB\xBFOFF"},
      {""},
  };
  for (Style style : styles) {
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      style.line_end = line_end;
      INFO(style.header << style.behind_point << style.behind_face << std::string(line_end).size());
      CHECK(volume(off_text(box(), style)) == Approx(6));
    }
  }
}

TEST_CASE("an OFF file may be a single line") {
  CHECK(volume(off_text(box(), {"OFF", "", "", " "})) == Approx(6));
  CHECK(volume(off_text(box(), {"COFF", " 255 0 0 255", "", " "})) == Approx(6));
  CHECK(volume(off_text(box(), {"STNOFF", " 0 0 1 0.5 0.5", "", " "})) == Approx(6));
}

TEST_CASE("a fourth coordinate divides the others") {
  std::string text = off_text(box_polygons({0, 0, 0}, {4, 6, 2}), {"4OFF", " 2"});
  CHECK(volume(text) == Approx(6));
}

TEST_CASE("a binary OFF file is read, its highest bytes first") {
  CHECK(volume(off_bytes(box(), "OFF BINARY\n", false, 0, 0)) == Approx(6));
  CHECK(volume(off_bytes(box(), "OFF binary\r\n", false, 0, 4)) == Approx(6));
  CHECK(volume(off_bytes(box(), "STCNOFF BINARY\n", false, 9, 3)) == Approx(6));
  CHECK(volume(off_bytes(box(), "4OFF BINARY\n", true, 0, 1)) == Approx(6));
}

TEST_CASE("a binary OFF file that is cut off or says too much is refused") {
  const std::string whole = off_bytes(box(), "OFF BINARY\n", false, 0, 0);
  for (std::size_t size = 11; size < whole.size(); ++size)
    CHECK(!why(whole.substr(0, size)).empty());
  std::string huge = whole;
  huge[11] = huge[15] = '\x7F';
  CHECK(why(huge).find("more points or faces") == 0);
}

TEST_CASE("faces of one or two corners are skipped") {
  std::string text = off_text(box(), {});
  text.replace(text.find("8 6 0"), 5, "8 8 0");
  CHECK(volume(text + "2 0 1\n1 0\n") == Approx(6));
}

TEST_CASE("what is wrong with an OFF file is said with the line and the word") {
  CHECK(why("PLY") == "line 1: expected \"OFF\", found \"PLY\"");
  CHECK(why("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") == "line 5: no point 3, there are 3");
  CHECK(why("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n") ==
        "line 4: expected a point's three numbers, found \"zero\"");
  CHECK(why("OFF\n4000000 1 0\n").find("line 2: more points or faces") == 0);
  CHECK(why("nOFF 4\n3 1 0\n").find("4 dimensions") != std::string::npos);
  CHECK(why("CCOFF 3 1 0").find("expected \"OFF\"") != std::string::npos);
  CHECK(why("ZOFF 3 1 0").find("expected \"OFF\"") != std::string::npos);
  CHECK(why("\xFE\xFF").find("UTF-16") != std::string::npos);
}
