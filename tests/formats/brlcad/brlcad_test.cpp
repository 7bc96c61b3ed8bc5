#include "formats/brlcad/brlcad.hpp"

#include <zlib.h>

#include <cmath>

#include "catch.hpp"
#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/words.hpp"
#include "formats/brlcad/model.hpp"
#include "formats/brlcad/reading.hpp"
#include "formats/brlcad/view.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("a version 4 text is read, its members bound as u - + bind") {
  // a u (b − c + d): c is taken from b only, d restricts b only.
  const std::string text = kV4Head + v4_box("a", 0, 0, 0, 1, 1, 1) + v4_box("b", 5, 0, 0, 4, 4, 4) +
                           v4_box("c", 0, 0, 0, 6, 6, 6) + v4_box("d", 5, 0, 0, 9, 2, 9) +
                           v4_region("r") + v4_member('u', "a") + v4_member('u', "b") +
                           v4_member('-', "c") + v4_member('+', "d");
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 1);
  CHECK(scene.objects[0].name == "r");
  CHECK(holds(scene, 0.5, 0.5, 0.5));
  CHECK_FALSE(holds(scene, 5.5, 1, 1));
  CHECK(holds(scene, 7, 1, 1));
  CHECK_FALSE(holds(scene, 7, 3, 1));
}

TEST_CASE("the same model in each format is the same scene") {
  const std::array<double, 16> moved{1, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5};
  const std::string v4 = kV4Head + v4_sphere("s", 1, 2, 3, 2) + v4_sphere("t", 2, 2, 3, 1) +
                         v4_region("r") + v4_member('u', "s", moved) + v4_member('-', "t", moved);
  const std::string v5 =
      "title {A model}\nunits mm\n"
      "put {s} ell V {1 2 3} A {2 0 0} B {0 2 0} C {0 0 2}\n"
      "put t ell V {2 2 3} A {1 0 0} B {0 1 0} C {0 0 1}\n"
      "put {r} comb region yes id 1000 tree {- {l s {1 0 0 10  0 1 0 0  0 0 1 0  0 0 0 0.5}} \\\n"
      "  {l {t} {1 0 0 10  0 1 0 0  0 0 1 0  0 0 0 0.5}}}\n"
      "attr set {r} region R region_id 1000\n";
  const Scene expected = scene_of(v4);
  CHECK(scene_of(v5) == expected);
  for (unsigned width = 0; width < 4; ++width) {
    INFO("width code " << width);
    V5Binary g;
    g.width_code = width;
    g.solid("s", 3, {1, 2, 3, 2, 0, 0, 0, 2, 0, 0, 0, 2});
    g.solid("t", 3, {2, 2, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    g.comb("r", {"s", "t"}, "\x01\x01\x04", {moved}, {0, 0},
           std::string("region\0R\0region_id\0001000\0\0", 26));
    CHECK(scene_of(g.bytes()) == expected);
  }
  // m[15] = 0.5 doubles lengths.
  CHECK(holds(expected, 20 + 2 - 3.9, 4, 6));
  CHECK_FALSE(holds(expected, 20 + 4, 4, 6));
}

TEST_CASE("a compressed body is unpacked") {
  V5Binary g;
  const std::string body = V5Binary::doubles({1, 2, 3, 2, 0, 0, 0, 2, 0, 0, 0, 2});
  uLongf size = compressBound(static_cast<uLong>(body.size()));
  std::string packed(size, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                   reinterpret_cast<const Bytef*>(body.data()),
                   static_cast<uLong>(body.size())) == Z_OK);
  packed.resize(size);
  g.object("s", 3, packed, {}, 1);
  CHECK(holds(scene_of(g.bytes()), 1, 2, 4.5));
  V5Binary broken;
  broken.object("s", 3, packed.substr(0, packed.size() / 2), {}, 1);
  CHECK(error_of(broken.bytes()).find("compressed") != std::string::npos);
}

TEST_CASE("regions become objects, air is left out, and what nothing refers to is on top") {
  const std::string text = kV4Head + v4_sphere("s", 0, 0, 0, 1) + v4_sphere("t", 5, 0, 0, 1) +
                           v4_region("r1") + v4_member('u', "s") + v4_region("r2") +
                           v4_member('u', "t") + v4_region("air", 1) + v4_member('u', "s") +
                           v4_group("all") + v4_member('u', "r1") + v4_member('u', "r2") +
                           v4_member('u', "air");
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.objects[0].name == "r1");
  CHECK(scene_of(text, {"r2"}).objects.size() == 1);
  const BrlcadTops tops = list_brlcad_tops(text);
  REQUIRE(tops.tops.size() == 1);
  CHECK(tops.tops[0].name == "all");
  CHECK(tops.tops[0].primitives == 3);
  CHECK(error_of(text, {"r3"}) == "r3: is not in the database");
}

TEST_CASE("a cut above regions cuts each of them") {
  const std::string text =
      "title t\nput a ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n"
      "put b ell V {9 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n"
      "put h half N {0 0 1} d 0\n"
      "put ra comb region yes tree {l a}\nput rb comb region yes tree {l b}\n"
      "put top comb region no tree {- {u {l ra} {l rb}} {l h}}\n";
  const Scene scene = scene_of(text);
  REQUIRE(scene.objects.size() == 2);
  CHECK(holds(scene, 0, 0, 1));
  CHECK(holds(scene, 9, 0, 1));
  CHECK_FALSE(holds(scene, 0, 0, -1));
  CHECK_FALSE(holds(scene, 9, 0, -1));
}

TEST_CASE("colours and shaders are inherited, and an upper one that insists wins") {
  const auto color_of = [](const std::string& upper, const std::string& lower) {
    const Scene scene = scene_of(
        "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\nput r comb region yes " +
        lower + " tree {l s}\nput g comb region no " + upper + " tree {l r}\n");
    REQUIRE(scene.objects.size() == 1);
    return scene.materials.at(scene.objects[0].material).material;
  };
  CHECK(color_of("rgb {255 0 0}", "").color == Rgb{1, 0, 0});
  CHECK(color_of("rgb {255 0 0}", "rgb {0 255 0}").color == Rgb{0, 1, 0});
  CHECK(color_of("rgb {255 0 0} inherit yes", "rgb {0 255 0}").color == Rgb{1, 0, 0});
  CHECK(color_of("shader {mirror {re 0.5}}", "").reflect == 0.5);
  CHECK(color_of("shader mirror", "shader {glass tr=0.25}").transmit == 0.25);
  CHECK(color_of("shader {mirror} inherit yes", "shader {glass}").transmit == 0);
}

TEST_CASE("the colours of regions by their numbers are read alike from text and binary") {
  const std::string table = "{1000 1999 10 20 30} {-1 5 300 -4 7} {3 4}";
  V5Binary g;
  g.attributes_only("_GLOBAL",
                    "regionid_colortable" + std::string(1, '\0') + table + std::string(2, '\0'));
  const std::string text = "title t\nattr set {_GLOBAL} {regionid_colortable} {" + table + "}\n";
  for (const std::string& bytes : {g.bytes(), text}) {
    BrlcadReport report;
    const BrlcadDatabase database = read_brlcad_database(bytes, report);
    REQUIRE_FALSE(report.has_errors());
    REQUIRE(database.colors.size() == 2);
    CHECK(database.colors[0].low == 1000);
    CHECK(database.colors[0].high == 1999);
    CHECK(database.colors[0].rgb == std::array<int, 3>{10, 20, 30});
    CHECK(database.colors[1].low == -1);
    CHECK(database.colors[1].rgb == std::array<int, 3>{255, 0, 7});
  }
}

TEST_CASE("a lamp shines, and an unknown shader is plastic with one warning") {
  const std::string text =
      "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\nput t ell V {9 0 0} A {1 0 0} B "
      "{0 1 0} C {0 0 1}\n"
      "put lamp comb region yes rgb {0 0 255} shader {light {f 0.5}} tree {l s}\n"
      "put a comb region yes shader {wood} tree {l t}\nput b comb region yes shader {wood} tree "
      "{l t}\n";
  const BrlcadResult result = read_brlcad(text);
  REQUIRE(result.scene);
  REQUIRE(result.scene->settings.lights.size() == 1);
  CHECK(result.scene->settings.lights[0].color == Rgb{0, 0, 0.5});
  CHECK(length(result.scene->settings.lights[0].position) < 1e-12);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text == "2 regions: the shader 'wood' is taken for plastic: a, b");
}

TEST_CASE("a hole flush with a face leaves no skin") {
  const std::string text = kV4Head + v4_box("a", 0, 0, 0, 9, 9, 1) + v4_box("b", 3, 3, 0, 3, 3, 1) +
                           v4_region("r") + v4_member('u', "a") + v4_member('-', "b");
  const Scene scene = scene_of(text);
  CHECK_FALSE(holds(scene, 4, 4, 1));
  CHECK_FALSE(holds(scene, 4, 4, 0));
  CHECK(holds(scene, 2, 4, 1));
}

TEST_CASE("faces of an arb that aren't flat lie in the plane of their first three corners") {
  // The top's corner at (9, 9) is 3 higher than the others; rt takes the corners 4, 5 and 6.
  std::vector<double> v{0, 0, 0, 9, 0, 0, 9, 9, 0, 0, 9, 0, 0, 0, 9, 9, 0, 9, 9, 9, 12, 0, 9, 9};
  const BrlcadResult bent = read_brlcad(kV4Head + v4_solid(20, "bent", v));
  REQUIRE(bent.scene);
  REQUIRE(bent.warnings.size() == 1);
  CHECK(bent.warnings[0].text.find("1 solid: faces aren't flat") == 0);
  CHECK_FALSE(bent.warnings[0].leaves_out);
  CHECK(holds(*bent.scene, 8.5, 8.5, 11.5));
  CHECK(holds(*bent.scene, 8.5, 1, 9.2));
  CHECK_FALSE(holds(*bent.scene, 8.5, 1, 9.8));
  v[20] = 9;
  const BrlcadResult flat = read_brlcad(kV4Head + v4_solid(20, "flat", v));
  REQUIRE(flat.scene);
  CHECK(flat.warnings.empty());
  CHECK(holds(*flat.scene, 4, 4, 4));
}

TEST_CASE("cones of all proportional kinds, particles and pipes hold the points they should") {
  const Scene cone = scene_of(
      "title t\nput c tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 1 0} C {1 0 0} D {0 0.5 0}\n");
  CHECK(holds(cone, 1.9, 0, 0.1));
  CHECK_FALSE(holds(cone, 1.9, 0, 3));
  CHECK(holds(cone, 0, 0.7, 2));
  CHECK_FALSE(holds(cone, 0, 0.8, 2));
  const Scene tip =
      scene_of("title t\nput c tgc V {0 0 0} H {0 0 4} A {0 0 0} B {0 0 0} C {2 0 0} D {0 2 0}\n");
  CHECK(holds(tip, 0.9, 0, 2));
  CHECK_FALSE(holds(tip, 0.9, 0, 1));
  const Scene part = scene_of("title t\nput p part V {0 0 0} H {0 0 10} r_v 3 r_h 1\n");
  CHECK(holds(part, 0, 0, -2.9));
  CHECK(holds(part, 0, 0, 10.9));
  CHECK(holds(part, 2, 0, 5));
  CHECK_FALSE(holds(part, 2.2, 0, 5));
  const Scene pipe = scene_of(
      "title t\nput p pipe V0 {0 0 0} O0 2 I0 1 R0 3 V1 {10 0 0} O1 2 I1 1 R1 3 V2 {10 10 0} O2 2 "
      "I2 1 R2 3\n");
  CHECK_FALSE(holds(pipe, 1, 0, 0));
  CHECK(holds(pipe, 1, 0.75, 0));
  CHECK_FALSE(holds(pipe, 0.0, 0, 0));
  CHECK(holds(pipe, 10, 8, 0.75));
  CHECK_FALSE(holds(pipe, 10, 0, 0));
  // On the bend's ring, about (7, 3, 0), half way.
  const double ring = 3 * std::sqrt(0.5);
  CHECK(holds(pipe, 7 + ring, 3 - ring, 0.75));
  CHECK_FALSE(holds(pipe, 7 + ring, 3 - ring, 0.25));
  CHECK_FALSE(holds(pipe, 7 - ring, 3 - ring, 0.75));
}

TEST_CASE("quadrics, elliptic tori and general cones hold the points they should") {
  const auto of = [](const std::string& solid) {
    return scene_of("title t\nput s " + solid + "\n");
  };
  // Half way up an epa of radii 2 and 1 its radii are √½ as long.
  const Scene epa = of("epa V {0 0 0} H {0 0 4} A {1 0 0} r_1 2 r_2 1");
  CHECK(holds(epa, 1.41, 0, 2));
  CHECK_FALSE(holds(epa, 1.42, 0, 2));
  CHECK(holds(epa, 0, 0.70, 2));
  CHECK_FALSE(holds(epa, 0, 0.72, 2));
  // With c = H the radius half way up is √((1.5² − 1) / 3) of the base's.
  const Scene ehy = of("ehy V {0 0 0} H {0 0 4} A {1 0 0} r_1 2 r_2 2 c 4");
  CHECK(holds(ehy, 1.28, 0, 2));
  CHECK_FALSE(holds(ehy, 1.30, 0, 2));
  CHECK_FALSE(holds(ehy, 0, 0, 4.01));
  const Scene rpc = of("rpc V {0 0 0} H {0 0 4} B {0 2 0} r 3");
  CHECK(holds(rpc, 2.1, 1, 3.9));
  CHECK_FALSE(holds(rpc, 2.2, 1, 3.9));
  CHECK_FALSE(holds(rpc, 0, 1, 4.1));
  const Scene rhc = of("rhc V {0 0 0} H {0 0 4} B {0 2 0} r 3 c 2");
  CHECK(holds(rhc, 1.93, 1, 3.9));
  CHECK_FALSE(holds(rhc, 1.95, 1, 3.9));
  const Scene hyp = of("hyp V {0 0 0} H {0 0 4} A {2 0 0} b 1 bnr 0.5");
  CHECK(holds(hyp, 0.99, 0, 2));
  CHECK_FALSE(holds(hyp, 1.01, 0, 2));
  CHECK(holds(hyp, 1.99, 0, 0.001));
  CHECK(holds(hyp, 0, 0.49, 2));
  CHECK_FALSE(holds(hyp, 0, 0.51, 2));
  // The ellipse's long semi-axis leans outwards and up by 45°.
  const Scene eto = of("eto V {0 0 0} N {0 0 1} C {1 0 1} r 5 r_d 0.5");
  CHECK(holds(eto, 5.99, 0, 0.99));
  CHECK(holds(eto, 0, 4.01, -0.99));
  CHECK_FALSE(holds(eto, 5.5, 0, -0.5));
  const Scene tgc = of("tgc V {0 0 0} H {0 0 4} A {2 0 0} B {0 1 0} C {1 0 0} D {0 2 0}");
  CHECK(holds(tgc, 1.49, 0, 2));
  CHECK_FALSE(holds(tgc, 1.51, 0, 2));
  CHECK(holds(tgc, 0, 1.49, 2));
  CHECK_FALSE(holds(tgc, 0, 1.51, 2));
}

TEST_CASE("a bot and an ars are meshes, in each format") {
  // A tetrahedron; its faces are turned any way.
  const std::string v5 =
      "title t\nput b bot mode volume orient no flags {} V {{0 0 0} {4 0 0} {0 4 0} {0 0 4}} "
      "F {{0 1 2} {0 1 3} {0 2 3} {1 2 3}}\n";
  const std::string v4 = kV4Head +
                         "t b 2 1 0 4 4\n\t0: 0 0 0\n\t1: 4 0 0\n\t2: 0 4 0\n\t3: 0 0 4\n"
                         "\t0: 0 1 2\n\t1: 0 1 3\n\t2: 0 2 3\n\t3: 1 2 3\n";
  for (const std::string& text : {v5, v4}) {
    const Scene scene = scene_of(text);
    CHECK(holds(scene, 0.9, 0.9, 0.9));
    CHECK_FALSE(holds(scene, 1.5, 1.5, 1.5));
  }
  // A pyramid of two curves: the base collapsed to its middle, a square, the tip.
  const std::string square = "{1 -1 0} {1 1 0} {-1 1 0} {-1 -1 0}";
  const auto curve = [](const std::string& p) {
    return "{" + p + " " + p + " " + p + " " + p + "}";
  };
  const Scene ars5 = scene_of("title t\nput a ars NC 3 PPC 4 C0 {" + curve("{0 0 0}").substr(1) +
                              " C1 {" + square + "} C2 " + curve("{0 0 3}") + "\n");
  const Scene ars4 =
      scene_of(kV4Head +
               "A 0 a 3 4\nB 1 1 0 0 0 0 0 0 0 0 0 0 0 0\nB 2 1 1 -1 0 1 1 0 -1 1 0 -1 -1 0\n"
               "B 3 1 0 0 3 0 0 3 0 0 3 0 0 3\n");
  for (const Scene* scene : {&ars5, &ars4}) {
    CHECK(holds(*scene, 0.1, 0.2, 1));
    CHECK_FALSE(holds(*scene, 0.9, 0.9, 1));
  }
}

TEST_CASE("a mesh that is cut off is larger by the skin on all sides") {
  const std::string bot =
      "put b bot mode volume orient rh flags {} V {{0 0 0} {4 0 0} {4 4 0} {0 4 0} {2 2 4}} "
      "F {{0 2 1} {0 3 2} {0 1 4} {1 2 4} {2 3 4} {3 0 4}}\n";
  const std::string box =
      "put s arb8 V1 {-1 -1 0} V2 {5 -1 0} V3 {5 5 0} V4 {-1 5 0} V5 {-1 -1 5} V6 {5 -1 5} "
      "V7 {5 5 5} V8 {-1 5 5}\n";
  const Scene cut =
      scene_of("title t\n" + bot + box + "put r comb region yes tree {- {l s} {l b}}\n", {"r"});
  // No skin is left below, where the faces are flush.
  CHECK_FALSE(holds(cut, 2.1, 2.2, 1e-6));
  CHECK_FALSE(holds(cut, 2.1, 2.2, 0));
  CHECK(holds(cut, 0.5, 0.1, 2));
}

TEST_CASE("faces that a bot has twice or both ways count once, as by rt") {
  for (const char* more : {"{0 2 1} {2 1 0}", "{0 1 2}", "{0 1 2} {0 3 1} {1 3 2} {2 3 0} "}) {
    INFO(more);
    const BrlcadResult result = read_brlcad(
        std::string("title t\nput s bot mode volume orient no flags {} V {{0 0 0} {4 0 0} {0 4 0} "
                    "{0 0 4}} F {{0 2 1} {0 1 3} {1 2 3} {0 3 2} ") +
        more + "}\nput r comb region yes tree {l s}\n");
    REQUIRE(result.scene);
    CHECK(holds(*result.scene, 1, 1, 1));
    CHECK_FALSE(holds(*result.scene, 2, 2, 1));
    REQUIRE(result.warnings.size() == 1);
    CHECK_FALSE(result.warnings[0].leaves_out);
    CHECK_THAT(result.warnings[0].text, Catch::Contains("count once"));
  }
}

TEST_CASE("an open bot is left out with a word of where") {
  const BrlcadResult read = read_brlcad(
      "title t\nput s ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\nput b bot mode volume "
      "orient rh flags {} V {{0 0 0} {4 0 0} {0 4 0} {0 0 4}} F {{0 2 1} {0 1 3} {0 3 2}}\n");
  REQUIRE(read.scene);
  CHECK(read.scene->objects.size() == 1);
  REQUIRE(read.warnings.size() == 1);
  CHECK(read.warnings[0].text.find("1 solid is left out (its mesh: not closed; b: the edge from") ==
        0);
  CHECK(read.warnings[0].leaves_out);
}

TEST_CASE("what can't be read is refused by name or line") {
  CHECK(error_of("put d dsp file x\nput r comb region yes tree {l d}\n", {"r"}) ==
        ": nothing is left to render: 1 region is left out (dsp is not supported): r");
  CHECK(error_of("put b bot mode plate V {} F {}\n").find("plate mode is not supported") !=
        std::string::npos);
  CHECK(error_of("put r comb region yes tree {l r}\n", {"r"}) ==
        "r: the combination contains itself");
  CHECK(error_of("title t\nput s ell V {0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n")
            .find("line 2: s: expected V") != std::string::npos);
  CHECK(error_of("title t\nput s ell V {0 0\n").find("brace") != std::string::npos);
  CHECK(error_of(kV4Head + "S 19 s 0 1 2 3\n").find("line 3: s: a solid's record wants") !=
        std::string::npos);
  CHECK(error_of(kV4Head + v4_sphere("s", 0, 0, 0, 1) + v4_region("r") +
                 v4_member('u', "s", {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}))
            .find("1 region is left out (a member's matrix is no invertible affine map): r") !=
        std::string::npos);
  CHECK(error_of("hello").find("no BRL-CAD database") != std::string::npos);
  CHECK(error_of(std::string("v\x01\0\0\0\0\x01\x35 and then", 17)).find("byte 8") == 0);
}

TEST_CASE("a superell is an ellipsoid where its exponents say so, and refused otherwise") {
  const auto text = [](const char* kind, const char* exponents) {
    return std::string("put s ") + kind + " V {1 2 3} A {3 0 0} B {0 2 0} C {0 0 1}" + exponents +
           "\n" + "put r comb region yes tree {l s}\n";
  };
  CHECK(scene_of(text("superell", " n 1 e 1"), {"r"}) == scene_of(text("ell", ""), {"r"}));
  CHECK(error_of(text("superell", " n 1 e 0.5"), {"r"}) ==
        ": nothing is left to render: 1 region is left out (superell with other exponents than n = "
        "e = 1 is not supported): r");
  CHECK(error_of(text("superell", " n 1"), {"r"}).find("expected e with 1 numbers") !=
        std::string::npos);
  V5Binary g;
  g.solid("s", 35, {1, 2, 3, 3, 0, 0, 0, 2, 0, 0, 0, 1, 1, 1});
  g.comb("r", {"s"}, "\x01", {}, {}, std::string("region\0R\0", 9));
  CHECK(scene_of(g.bytes(), {"r"}) == scene_of(text("ell", ""), {"r"}));
}

TEST_CASE("a missing member is left out, with a warning") {
  const BrlcadResult result = read_brlcad(kV4Head + v4_sphere("s", 0, 0, 0, 1) + v4_region("r") +
                                          v4_member('u', "s") + v4_member('-', "gone"));
  REQUIRE(result.scene);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].where == "gone");
  CHECK(result.warnings[0].text == "is not in the database, and left out");
  CHECK(result.warnings[0].leaves_out);
}

TEST_CASE("a view script and a quaternion give the axes of rt") {
  BrlcadReport report;
  const auto by_rows = read_brlcad_view(
      "viewsize 10;\neye_pt 1 2 3;\nviewrot -0.5 0.8660254037844386 0 0\n 0 0 1 0\n "
      "0.8660254037844386 0.5 0 0\n 0 0 0 1;\n"
      "start 0; clean; end;",
      report);
  REQUIRE(by_rows);
  CHECK(by_rows->size == 10);
  CHECK(by_rows->camera.pixel_offset == std::array<double, 2>{0, 0});
  CHECK(by_rows->camera.projection == Projection::kOrthographic);
  CHECK(by_rows->camera.width == 10);
  const BrlcadAxes axes = brlcad_axes(by_rows->camera);
  CHECK(length(axes.right - Vec3{-0.5, 0.8660254037844386, 0}) < 1e-12);
  CHECK(length(axes.backward - Vec3{0.8660254037844386, 0.5, 0}) < 1e-12);
  // Azimuth 35, elevation 25.
  const auto by_quaternion = read_brlcad_view(
      "viewsize 10; orientation 0.248097 0.476591 0.748097 0.389435; eye_pt 0 0 0;", report);
  REQUIRE(by_quaternion);
  const BrlcadAxes turned = brlcad_axes(by_quaternion->camera);
  const Camera framed = brlcad_view(35, 25, {{-0.2, -1, -1}, {1, 0.1, 1}}).camera;
  CHECK(length(turned.backward - brlcad_axes(framed).backward) < 1e-5);
  CHECK(length(turned.up - brlcad_axes(framed).up) < 1e-5);
  CHECK(framed.width == Approx(std::sqrt(12.0)));
  CHECK(length(framed.eye) == Approx(std::sqrt(6.0)));
  CHECK_FALSE(read_brlcad_view("viewsize 10; eye_pt 0 0 0;", report));
  const auto seen =
      read_brlcad_view("viewsize 10; eye_pt 0 0 5; lookat_pt 1 0 5; perspective 30;", report);
  REQUIRE(seen);
  CHECK(seen->camera.projection == Projection::kPerspective);
  CHECK(seen->camera.fov_degrees == 30);
}

TEST_CASE("a region without end is framed by its finite solids, where they are in it") {
  // Below z = 0: a half-space far off, and the lower half of a ball.
  const Scene scene = scene_of(
      "title t\nput h half N {0 0 1} d 0\nput far half N {1 0 0} d -100\nput s ell V {0 0 0} A {2 "
      "0 "
      "0} B {0 2 0} C {0 0 2}\nput r comb region yes tree {n {l h} {u {l far} {l s}}}\n");
  CHECK(scene.settings.camera.width == Approx(std::sqrt(4.0 * 4 + 4 * 4 + 2 * 2)));
}

TEST_CASE("of a view script's frames the first counts") {
  BrlcadReport report;
  const auto view = read_brlcad_view(
      "viewsize 10; eye_pt 0 0 5; lookat_pt 1 0 5; end; viewsize 20; eye_pt 1 1 1; end;", report);
  REQUIRE(view);
  CHECK(view->size == 10);
  CHECK(view->camera.eye == Vec3{0, 0, 5});
}

TEST_CASE("Tcl words are cut as Tcl does") {
  const auto words_of = [](TclWords words) {
    std::vector<std::string> list;
    for (std::string word; words.next(word);) list.push_back(word);
    if (words.is_broken()) list.push_back("broken");
    return list;
  };
  CHECK(words_of(TclWords("a {b {c d}} \"e f\" g\\ h")) ==
        std::vector<std::string>{"a", "b {c d}", "e f", "g h"});
  CHECK(words_of(TclWords("{a")) == std::vector<std::string>{"broken"});
  TclWords script("a b\n# c\n\n d ; e\\\n f\n", TclWords::Ends::kAtLine);
  std::vector<std::vector<std::string>> lines;
  while (script.next_line()) {
    auto& line = lines.emplace_back();
    for (std::string w; script.next(w);) line.push_back(w);
  }
  CHECK(lines == std::vector<std::vector<std::string>>{{"a", "b"}, {"d"}, {"e", "f"}});
}
