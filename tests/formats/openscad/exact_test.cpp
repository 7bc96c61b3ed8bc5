#include "formats/openscad/language/exact.hpp"

#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "catch.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

/// A number as the definitions write it: an exponent, and 12 + 16 + 16 + 16 binary digits.
std::string spelled(double v) {
  if (v == std::floor(v) && std::fabs(v) < 1e5) return std::to_string(static_cast<int>(v));
  const int exponent = std::ilogb(v);
  double rest = std::ldexp(std::fabs(v), 12 - exponent);
  std::string text = "[" + std::to_string(exponent);
  for (int i = 0; i < 4; ++i) {
    const int part = static_cast<int>(rest);
    text += ", " + std::to_string(i == 0 && v < 0 ? -part : part);
    rest = (rest - part) * 65536;
  }
  return text + "]";
}
std::string spelled(std::initializer_list<double> list) {
  std::string text = "[";
  for (const double v : list) text += (text.size() > 1 ? ", " : "") + spelled(v);
  return text + "]";
}

/// The tree to which a module of ours evaluates, with its note.
std::string note(const std::string& module, const std::string& lists,
                 const std::string& children = "") {
  return "group() { group() { text(text = \"graycube|" + module + "|" + lists +
         "\", size = 10); } " + children + " }";
}
std::string note_of_cube(double x, double y, double z) {
  return note("cube", "size=" + spelled({x, y, z}) + "|");
}
std::string note_of_shift(double x, double y, double z, const std::string& children) {
  return note("multmatrix", "m=" + spelled({1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}) + "|",
              "group() {" + children + "}");
}
std::string shift(const std::string& by, const std::string& children) {
  const std::string m = "[[1, 0, 0, " + by + "], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
  return "multmatrix(" + m + ") { " + children + " }";
}

Scene scene_of(const std::string& plain, const std::string& marked) {
  OpenscadOptions options;
  options.spelled_out = marked;
  return testing::scene_of(plain, options);
}
Vec3 size_of(const Scene& scene, std::size_t object = 0) {
  return std::get<BoxShape>(scene.objects.at(object).csg.value).max;
}

constexpr const char* kThird = "cube(size = [0.333333, 2, 3], center = false);";
constexpr double kOneThird = 1.0 / 3;

/// Two cylinders that cross, whose hull has no exact form; `aside` moves the upright one.
std::string crossing_hull(const std::string& aside) {
  return "hull() { " + shift(aside, "cylinder($fn = 40, h = 8, r1 = 10, r2 = 10);") +
         "multmatrix([[1, 0, 0, 30], [0, 0, -1, 0], [0, 1, 0, 4], [0, 0, 0, 1]]) { cylinder($fn = "
         "40, h = 9, r1 = 4, r2 = 4); } }";
}
std::string note_of_cylinder(double h, double r) {
  return note("cylinder", "$fn=" + spelled({40}) + "|h=" + spelled({h}) + "|r1=" + spelled({r}) +
                              "|r2=" + spelled({r}) + "|");
}
std::string note_of_crossing_hull(double aside) {
  return "hull() { " + note_of_shift(aside, 0, 0, note_of_cylinder(8, 10)) +
         note("multmatrix",
              "m=" + spelled({1, 0, 0, 30, 0, 0, -1, 0, 0, 1, 0, 4, 0, 0, 0, 1}) + "|",
              "group() {" + note_of_cylinder(9, 4) + "}") +
         " }";
}

TEST_CASE("twelve digits count where rounds get facets, since corners tell planes no better") {
  const Scene faceted = scene_of(crossing_hull("0.333333"), note_of_crossing_hull(kOneThird));
  CHECK(faceted.digits == 12);
  const Scene round = scene_of(shift("0.333333", "cylinder($fn = 40, h = 8, r1 = 10, r2 = 10);"),
                               note_of_shift(kOneThird, 0, 0, note_of_cylinder(8, 10)));
  CHECK(round.digits == 0);
}

TEST_CASE("numbers that are spelled out come back to the last bit") {
  std::mt19937_64 random(19);
  for (int i = 0; i < 2000; ++i) {
    const double v = std::ldexp(1 + std::generate_canonical<double, 53>(random),
                                static_cast<int>(random() % 60) - 30);
    char six[40];
    std::snprintf(six, sizeof six, "%.5e", v);
    INFO("i " << i << ", " << six);
    const Scene scene = scene_of("cube(size = [" + std::string(six) + ", 2, 3], center = false);",
                                 note_of_cube(v, 2, 3));
    CHECK(size_of(scene) == Vec3{v, 2, 3});
    CHECK(scene.digits == 0);
  }
}

TEST_CASE("a translation and what is in it are spelled out, negative ones too") {
  const Scene scene = scene_of(shift("-0.142857", kThird),
                               note_of_shift(-1.0 / 7, 0, 0, note_of_cube(kOneThird, 2, 3)));
  CHECK(size_of(scene).x == kOneThird);
  REQUIRE(scene.objects[0].csg.transform);
  CHECK(scene.objects[0].csg.transform->translation().x == -1.0 / 7);
}

TEST_CASE("groups are no difference between the trees") {
  const std::string cube = note_of_cube(kOneThird, 2, 3);
  for (const std::string& marked :
       {"group() { group() { " + cube + " } } group();", "group(); " + cube}) {
    CHECK(size_of(scene_of(std::string("group() { ") + kThird + " }", marked)).x == kOneThird);
  }
}

TEST_CASE("a tree of another shape, or of other numbers, is ignored as a whole") {
  const std::string cube = note_of_cube(kOneThird, 2, 3), plain = kThird;
  const auto stays = [](const std::string& of, const std::string& marked) {
    const Scene scene = scene_of(of, marked);
    INFO(marked);
    CHECK(scene.digits == 6);
    CHECK(size_of(scene).x == 0.333333);
  };
  stays(plain, "");
  stays(plain, "cube(size = [");
  stays(plain, plain);
  stays(plain, cube + cube);
  stays(plain, "#" + cube + "%" + cube);
  stays(plain, note("square", "size=" + spelled({kOneThird, 2, 3}) + "|"));
  stays(plain, note_of_cube(0.3333336, 2, 3));
  stays(plain, note_of_cube(-kOneThird, 2, 3));
  stays(plain, note("cube", "size=" + spelled({kOneThird, 2}) + "|"));
  stays(plain, note("cube", "size=" + spelled({kOneThird, 2, 3, 4}) + "|"));
  stays(plain, note("cube", "size=[undef, 2, 3]|"));
  stays(plain, note("cube", "size=[[-2, 5461, 21845], 2, 3]|"));
  stays(plain, note("cube", "size=[[-2, 5461, 21845, 21845, 99999], 2, 3]|"));
  stays(plain, note("cube", "size=[[9999999999, 5461, 21845, 21845, 21760], 2, 3]|"));
  stays(plain, note("cube", "size"));
  stays(plain, note("cube", ""));
  // All numbers are improved or none: the first cube alone would match.
  stays(plain + plain, cube + note_of_cube(0.5, 2, 3));
  stays(plain + shift("0.142857", plain), cube + note_of_shift(0.2, 0, 0, cube));
  stays(plain + "difference() { cube(1); cube(1); }",
        cube + "difference() { " + note_of_cube(1, 1, 1) + " }");
  CHECK(scene_of(plain, cube).digits == 0);
}

TEST_CASE("a number halfway between two of six digits may be written either way") {
  for (const char* six : {"1.01562", "1.01563"}) {
    const std::string plain = "cube(size = [" + std::string(six) + ", 2, 3], center = false);";
    CHECK(size_of(scene_of(plain, note_of_cube(1.015625, 2, 3))).x == 1.015625);
  }
}

TEST_CASE("numbers of newer versions that stand for two are spelled out") {
  const auto tapered = [](double x, double y) {
    return note(
        "linear_extrude",
        "$fn=[0]|height=" + spelled({kOneThird}) + "|twist=[0]|scale=" + spelled({x, y}) + "|",
        "group() {" + note("square", "size=" + spelled({1, 1}) + "|") + "}");
  };
  const std::string plain =
      "linear_extrude(height = 0.333333, scale = 0.142857, $fn = 0) { square(size = [1, 1], center "
      "= false); }";
  CHECK(scene_of(plain, tapered(1.0 / 7, 1.0 / 7)).digits == 0);
  CHECK(scene_of(plain, tapered(1.0 / 7, 0.2)).digits == 6);
}

TEST_CASE("flat shapes that OpenSCAD evaluates leave a scene its six digits") {
  struct Program : OpenscadProgram {
    Result evaluate(const std::string&, Format) override {
      return {"<svg><path d=\"M 0,0 L 2,0 L 1,-3 z\"/></svg>", {}};
    }
  } program;
  OpenscadOptions options;
  const std::string marked =
      note_of_cube(kOneThird, 2, 3) +
      note("linear_extrude", "height=[1]|", "group() { text(text = \"a\"); }");
  options.spelled_out = marked;
  options.program = &program;
  const Scene scene = testing::scene_of(
      "cube(size = [0.333333, 2, 3], center = false); linear_extrude(height = 1) text(text = "
      "\"a\");",
      options);
  CHECK(size_of(scene).x == kOneThird);
  CHECK(scene.digits == 6);
}

}  // namespace
}  // namespace graycube
