// Repeats as compiled: the same model as shapes that refer to one another level by level.
#include <string>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"
#include "scene/repeat.hpp"
#include "scene/scene_fault.hpp"

using namespace graycube;

namespace {

Scene scene_of(const std::string& csg, const std::string& shapes = "") {
  const ReadResult read = read_scene_text(
      R"({"graycube": 1, "image": {"width": 4, "height": 4},
  "camera": {"type": "perspective", "eye": [0,0,-8], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
  "lights": [], "materials": {"m": {}, "n": {}}, "shapes": {)" +
      shapes + R"(}, "objects": [{"name": "o", "material": "m", "csg": )" + csg + "}]}");
  for (const SceneError& e : read.errors) UNSCOPED_INFO(e.pointer << ": " << e.message);
  REQUIRE(read.scene);
  return *read.scene;
}

const std::string kChild = R"({"type": "difference", "children": [
  {"type": "sphere", "center": [0.1,0.2,0.3], "radius": 0.7},
  {"type": "box", "min": [0,0,0], "max": [1,1,1], "material": "n"}]})";
const std::string kMaps[] = {
    R"([{"rotate": {"axis": [1,2,3], "angle": 25}}, {"translate": [2,0,0.3]}])",
    R"([{"scale": [0.7,0.3,-0.9]}, {"translate": [0,3,0]}])",
    R"([{"matrix": [[1,0.2,0,5],[0,1,0,0],[0.1,0,1,-2]]}])"};

std::string repeat(int depth, const std::string& keep) {
  return R"({"type": "repeat", "child": )" + kChild + R"(, "maps": [)" + kMaps[0] + "," + kMaps[1] +
         "," + kMaps[2] + R"(], "depth": )" + std::to_string(depth) + R"(, "keep": ")" + keep +
         "\"}";
}

/// Shapes s0, s1 …: s0 is the child, and each next one has the one before under each map; with
/// `keep` "all", the child comes first.
std::string levels(int depth, const std::string& keep) {
  std::string shapes = "\"s0\": " + kChild;
  for (int level = 1; level <= depth; ++level) {
    const std::string before = std::to_string(level - 1);
    shapes += ",\"s" + std::to_string(level) + R"(": {"type": "union", "children": [)";
    if (keep == "all") shapes += R"({"type": "ref", "shape": "s0"},)";
    for (int m = 0; m < 3; ++m) {
      shapes += (m > 0 ? "," : "") + (R"({"type": "ref", "shape": "s)" + before) +
                R"(", "transform": )" + kMaps[m] + "}";
    }
    shapes += "]}";
  }
  return shapes;
}

std::string ref(int shape) {
  return R"({"type": "ref", "shape": "s)" + std::to_string(shape) + "\"}";
}
std::string turned(const std::string& node) {
  return R"({"type": "union", "transform": [{"rotate": {"axis": [1,1,0], "angle": 10}}],
             "children": [)" +
         node + "]}";
}
std::string less(const std::string& node) {
  return R"({"type": "difference", "children": [
    {"type": "box", "min": [-9,-9,-9], "max": [9,9,9]}, )" +
         node + "]}";
}

}  // namespace

TEST_CASE("a repeat is what refs to shapes of shapes are, to the bit") {
  for (const char* keep : {"all", "last"}) {
    for (int depth = 0; depth <= 4; ++depth) {
      INFO(keep << " to depth " << depth);
      const Model model = compile_scene(scene_of(turned(repeat(depth, keep))));
      CHECK((model == compile_scene(scene_of(turned(ref(depth)), levels(depth, keep)))));
      const Model cut = compile_scene(scene_of(less(repeat(depth, keep))));
      CHECK((cut == compile_scene(scene_of(less(ref(depth)), levels(depth, keep)))));
    }
  }
}

TEST_CASE("a repeat has a copy for each way to take so many maps") {
  CHECK(compile_scene(scene_of(repeat(3, "all"))).primitives.size() == 2 * (1 + 3 + 9 + 27));
  CHECK(compile_scene(scene_of(repeat(3, "last"))).primitives.size() == 2 * 27);
  static_assert(counts_of_repeat(3, 3, KeptCopies::kAll).copies == 40);
  static_assert(counts_of_repeat(3, 3, KeptCopies::kLast).copies == 27);
  static_assert(counts_of_repeat(3, 3, KeptCopies::kLast).products == 40);
  static_assert(counts_of_repeat(1000, 256, KeptCopies::kAll).copies == kCountless);
}

TEST_CASE("only the first of a leaf's copies that can't be computed is told") {
  const std::string csg = R"({"type": "repeat", "depth": 100, "maps": [[{"scale": 1000}]], "child":
    {"type": "union", "children": [{"type": "sphere", "center": [0,0,0], "radius": 2},
                                   {"type": "box", "min": [0,0,0], "max": [1,1,1]}]}})";
  try {
    compile_scene(scene_of(csg));
    FAIL("a sphere of radius 2e300 was compiled");
  } catch (const UnrenderableScene& e) {
    REQUIRE(e.faults().size() == 2);
    CHECK(e.faults()[0].pointer == "/objects/0/csg/child/children/0");
    CHECK(e.faults()[0].message ==
          "the sphere of \"o\" reaches beyond 1e18, under 6 maps of /objects/0/csg");
    CHECK(e.faults()[1].pointer == "/objects/0/csg/child/children/1");
    CHECK(e.faults()[1].message ==
          "the box of \"o\" reaches beyond 1e18, under 7 maps of /objects/0/csg");
  }
}
