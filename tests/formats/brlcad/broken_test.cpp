// Objects that can't be read: they leave out the regions that use them, and nothing else, in each
// of the formats.
#include <cmath>
#include <string>

#include "model.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Reads a database whose region "good" is sound and whose region "bad" is not; what is said of the
/// latter.
std::string said_of_bad(const std::string& bytes) {
  const BrlcadResult result = read_brlcad(bytes);
  for (const auto& e : result.errors) UNSCOPED_INFO(e.where << ": " << e.text);
  REQUIRE(result.scene);
  REQUIRE(result.scene->objects.size() == 1);
  CHECK(result.scene->objects[0].name == "good");
  CHECK(holds(*result.scene, 0, 0, 1.9));
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].leaves_out);
  return result.warnings[0].text;
}

/// What is said, with the place and the fault of "s".
std::string expected(const std::string& where, const std::string& why) {
  return "1 region is left out (an object can't be read; bad: " + where + ": s: " + why + "): bad";
}

std::string v5_text(const std::string& put) {
  return "title t\nput b ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n" + put +
         "put good comb region yes tree {l b}\nput bad comb region yes tree {u {l b} {l s}}\n";
}
std::string v4_text(const std::string& records) {
  return kV4Head + v4_sphere("b", 0, 0, 0, 2) + records + v4_region("good") + v4_member('u', "b") +
         v4_region("bad") + v4_member('u', "b") + v4_member('u', "s");
}

struct Case {
  std::string record, where, why;
};

}  // namespace

TEST_CASE("a solid that can't be read leaves out its region only, in a text of version 5") {
  const std::string ell = "expected B with 3 numbers", line = "line 3";
  const Case cases[] = {
      {"put s ell V {0 0 0} A {1 0 0} B {0 one 0} C {0 0 1}\n", line, ell},
      {"put s ell V {0 0 0} A {1 0 0} B {0 1} C {0 0 1}\n", line, ell},
      {"put s ell V {0 0 0} A {1 0 0} B {0 1 0 0} C {0 0 1}\n", line, ell},
      {"put s ell V {0 0 0} A {1 0 0} B {0 nan 0} C {0 0 1}\n", line, ell},
      {"put s ell V {0 0 0} A {1 0 0} C {0 0 1} B\n", line, ell},
      {"put s\n", line, "'put' wants a kind behind the name"},
      {"put s arbn P0 {1 0 0 1} P1 {1 0 0}\n", line, "expected P1 with 4 numbers"},
      {"put s pipe V0 {0 0 0} O0 1 I0 0 R0 x\n", line, "expected V0, O0, I0 and R0"},
      {"put s pipe V0 {0 0 0} O0 1 I0 0 R0 1 V1 {9 0 0} O1 1\n", line,
       "its last point is not whole"},
      {"put s ars NC 2 PPC 3 C0 {{0 0 0} {1 0 0} {0 1 0}}\n", line,
       "expected two curves or more of three points or more"},
      {"put s ars NC 2 PPC 3 C0 {{0 0 0} {1 0 0} {0 1}}\n", line,
       "expected a list of three numbers each"},
      {"put s ars NC 2 PPC 3 C0 {{0 0 0} {1 0 0} {0 1 0}} C1 {{0 0 0}}\n", line,
       "its curves differ in their number of points"},
      {"put s bot mode volume V {{0 0 0}}\n", line, "expected V and F"},
      {"put s bot mode volume V {{0 0 0} {1 0 0} {0 1 0}} F {{0 1 3}}\n", line,
       "a face names a vertex that isn't there"},
      {"put s comb region no tree {u {l b}}\n", line,
       "its tree is no Boolean tree of BRL-CAD's, or deeper than 100 levels"},
  };
  for (const Case& c : cases) {
    INFO(c.record);
    CHECK(said_of_bad(v5_text(c.record)) == expected(c.where, c.why));
  }
}

TEST_CASE("a solid that can't be read leaves out its region only, in a text of version 4") {
  const Case cases[] = {
      {"S 19 s 0 1 2 3\n", "line 4",
       "a solid's record wants a type, a name, a class and 24 numbers"},
      {"S x s 0 1 2 3\n", "line 4",
       "a solid's record wants a type, a name, a class and 24 numbers"},
      {"p s 0 0 0 0 0 1 2\n", "line 4", "a particle wants a name and 8 numbers"},
      {"n s 2\nN 1 0 0 1\nN 1 0 0\n", "line 6", "a plane wants 4 numbers behind its first word"},
      {"n s 2\nN 1 0 0 1\n", "line 6", "a plane wants 4 numbers behind its first word"},
      {"n s many\nN 1 0 0 1\n", "line 4", "an arbn wants a name and the number of its planes"},
      {"w s\n0 2 1 0 0 0\n0 2 1 9 0\n0 2 1 9 0 0\nEND_PIPE\n", "line 6",
       "a point of a pipe wants 6 numbers"},
      {"w s\n0 2 1 0 0 0\n", "line 6", "it has no END_PIPE"},
      {"A s 2 3\nB 0 0 0 0 0 1 0 0 0 1 0\nB 1 0 0 0\n", "line 6",
       "a B record wants 3 words and points of 3 numbers"},
      {"A s 2 3\nB 0 0 0 0 0 1 0 0 0 1 0\n", "line 6", "a B record is missing"},
      {"A s 2 1\nB 0 0 0 0 0\n", "line 4",
       "an ars wants a name, the number of its curves (2 or more) and of their points (3 or more)"},
      {"t s 2 0 0 3 1\n\t0: 0 0 0\n\t1: 1 0 0\n\t2: 0 1 0\n\t0: 0 1 3\n", "line 8",
       "a face names a vertex that isn't there"},
      {"t s 2 0 0 3 1\n\t0: 0 0 0\n\t1: 1 0\n\t2: 0 1 0\n\t0: 0 1 2\n", "line 6",
       "a row wants 3 numbers behind its first word"},
      {"t s 2 0 0 3\n\t0: 0 0 0\n", "line 4",
       "a bot wants name, mode, orientation, error mode, number of vertices and of faces"},
      {"C N s 0 0\nM u b\n", "line 4", "a combination's record is too short"},
      {v4_group("s") + "M u\nM u b\n", "line 5",
       "a member wants an operation, a name and a matrix"},
  };
  for (const Case& c : cases) {
    INFO(c.record);
    CHECK(said_of_bad(v4_text(c.record)) == expected(c.where, c.why));
  }
}

TEST_CASE("a member whose matrix can't be read leaves out its region only") {
  const std::string bad = v4_region("bad") + "M u b 1 0 0 0 0 1 0 0 0 0 1 zero 0 0 0 1 0\n";
  CHECK(said_of_bad(kV4Head + v4_sphere("b", 0, 0, 0, 2) + v4_region("good") + v4_member('u', "b") +
                    bad) ==
        "1 region is left out (a member's matrix is no invertible affine map): bad");
}

TEST_CASE("a solid whose numbers can't be computed with leaves out its region only") {
  const std::string put =
      "put s ell V {5 4 -6} A {1e-300 1e-300 1e-17} B {8 1e-9 1e-17} C {-6 1e-6 -3}\n";
  CHECK(said_of_bad(v5_text(put)) ==
        "1 region is left out (a solid can't be computed; bad: the ellipsoid of \"bad\" is smaller "
        "than 1e-18): bad");
  // Lamps are counted without it.
  const BrlcadResult lit =
      read_brlcad(v5_text(put) + "put lamp comb region yes shader light tree {l b}\n");
  REQUIRE(lit.scene);
  CHECK(lit.scene->objects.back().name == "lamp");
  REQUIRE(lit.scene->settings.lights.size() == 1);
  CHECK(lit.scene->settings.lights[0].position == Vec3{});
}

TEST_CASE("a solid that can't be read leaves out its region only, in a binary of version 5") {
  struct Body {
    int minor;
    std::string bytes, why;
  };
  const double none = std::nan("");
  const Body bodies[] = {
      {3, V5Binary::doubles({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), "expected 12 numbers"},
      {3, V5Binary::doubles({0, 0, 0, 1, 0, 0, 0, none, 0, 0, 0, 1}), "expected 12 numbers"},
      {14, V5Binary::big(2, 4) + V5Binary::doubles({1, 0, 0, 1}), "expected 8 numbers"},
      {14, V5Binary::big(0xFFFFFFFF, 4), "too many numbers"},
      {5, V5Binary::big(2, 4) + V5Binary::big(3, 4), "more points than it has room for"},
      {30, V5Binary::big(0, 4) + V5Binary::big(9, 4) + std::string("\x02\x02\x00", 3),
       "more faces than it has room for"},
      {31, std::string("\0\0\x01\x04\x01\x01", 6) + std::string("x\0\0", 3) + '\x02',
       "a member's matrix isn't there"},
  };
  for (const Body& body : bodies) {
    INFO(body.minor << ": " << body.why);
    V5Binary g;
    g.solid("b", 3, {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2});
    const std::size_t at = g.bytes().size();
    g.object("s", body.minor, body.bytes, {});
    const std::string region("region\0R\0", 9);
    g.comb("good", {"b"}, "\x01", {}, {}, region);
    g.comb("bad", {"b", "s"}, "\x01\x01\x02", {}, {}, region);
    CHECK(said_of_bad(g.bytes()) == expected("byte " + std::to_string(at), body.why));
  }
}
