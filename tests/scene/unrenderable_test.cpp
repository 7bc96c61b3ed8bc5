// Solids whose numbers leave the range in which pictures can be computed: each is told with its
// pointer before anything is traced.
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene_fault.hpp"

using namespace graycube;

namespace {

/// A scene of shapes and objects in JSON, with materials.
Scene scene_of(const std::string& objects, const std::string& shapes = "") {
  const ReadResult read = read_scene_text(
      R"({"graycube": 1, "image": {"width": 4, "height": 4},
  "camera": {"type": "perspective", "eye": [0,0,-8], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
  "lights": [], "materials": {"m": {}}, "shapes": {)" +
      shapes + R"(}, "objects": [)" + objects + "]}");
  for (const SceneError& e : read.errors) UNSCOPED_INFO(e.pointer << ": " << e.message);
  REQUIRE(read.scene);
  return *read.scene;
}

std::string object(const std::string& csg) {
  return R"({"name": "o", "material": "m", "csg": )" + csg + "}";
}

/// A solid under a map that turns, stretches, turns, stretches across and turns.
std::string squeezed(const std::string& solid, const std::string& inner, const std::string& outer) {
  return R"({"type": "union", "children": [{"type": "union", "children": [)" + solid +
         R"(], "transform": [{"rotate": {"axis": [2,1,0], "angle": 50}}, {"scale": )" + inner +
         R"(}, {"rotate": {"axis": [1,2,3], "angle": 33}}]}], "transform": [{"scale": )" + outer +
         R"(}, {"rotate": {"axis": [3,1,1], "angle": 70}}]})";
}

std::vector<SceneFault> faults_of(const Scene& scene) {
  try {
    compile_scene(scene);
  } catch (const UnrenderableScene& e) {
    return e.faults();
  }
  return {};
}

/// One solid of each kind, about as large as `1`.
const std::vector<std::pair<std::string, std::string>> kSolids{
    {"ellipsoid", R"({"type": "sphere", "center": [0,0,0], "radius": 1})"},
    {"parallelepiped", R"({"type": "box", "min": [0,0,0], "max": [1,1,1]})"},
    {"cylinder", R"({"type": "cylinder", "base": [0,0,0], "top": [0,0,1], "radius": 1})"},
    {"cone",
     R"({"type": "cone", "base": [0,0,0], "base_radius": 1, "top": [0,0,1], "top_radius": 0})"},
    {"torus", R"({"type": "torus", "center": [0,0,0], "axis": [0,0,1], "major": 1, "minor": 0.2})"},
    {"half_space", R"({"type": "half_space", "normal": [1,1,0], "offset": 1})"},
    {"polyhedron", R"({"type": "polyhedron", "planes": [[1,0,0,1],[0,1,0,1],[-1,-1,1,1]]})"},
    {"elliptic_cone", R"({"type": "elliptic_cone", "base": [0,0,0], "top": [0,0,1], "a": [1,0,0], )"
                      R"("b": [0,1,0], "top_a": 0.5, "top_b": 0.2})"},
    {"elliptic_torus",
     R"({"type": "elliptic_torus", "center": [0,0,0], "axis": [0,0,1], "radius": 1, )"
     R"("outward": 0.2, "upward": 0.1, "across": 0.3})"},
    {"quadric",
     R"({"type": "quadric", "coefficients": [1,0,1,-1], "min": [-1,-1,0], "max": [1,1,1]})"},
};

}  // namespace

TEST_CASE("maps that are singular together are an error of each solid, with its pointer") {
  for (const auto& [kind, solid] : kSolids) {
    INFO(kind);
    const auto faults =
        faults_of(scene_of(object(squeezed(solid, "[1e-7, 1, 1]", "[1, 1e-7, 1]"))));
    REQUIRE(faults.size() == 1);
    CHECK(faults.front().pointer == "/objects/0/csg/children/0/children/0");
    CHECK(faults.front().message.starts_with("the " + kind + " of \"o\" is singular"));
    CHECK(faults_of(scene_of(object(squeezed(solid, "[1e-3, 1, 1]", "[1, 1e-3, 1]")))).empty());
  }
}

TEST_CASE("a solid beyond the range of coordinates, or too small, is an error") {
  for (const char* factor : {"1e25", "1e-25", "1e290", "1e-290"}) {
    for (const auto& [kind, solid] : kSolids) {
      INFO(kind << " times " << factor);
      const bool has_size = kind != "half_space" && kind != "polyhedron";
      const auto faults = faults_of(scene_of(object(squeezed(solid, factor, "[1, 2, 3]"))));
      CHECK((faults.size() == 1 || (factor[2] == '-' && !has_size)));
    }
  }
  const auto far = faults_of(
      scene_of(object(R"({"type": "complement", "child": {"type": "sphere", "center": [0,2e18,0], )"
                      R"("radius": 1}})")));
  REQUIRE(far.size() == 1);
  CHECK(far.front().pointer == "/objects/0/csg/child");
  CHECK(far.front().message == "the sphere of \"o\" reaches beyond 1e18");
}

TEST_CASE("a solid in a shape is told with the place of the shape and that of its use") {
  const auto faults = faults_of(
      scene_of(object(R"({"type": "ref", "shape": "a/b"})") + "," +
                   object(R"({"type": "ref", "shape": "a/b", "transform": [{"scale": 1e21}]})"),
               R"("a/b": {"type": "union", "children": [
                    {"type": "sphere", "center": [0,0,0], "radius": 1},
                    {"type": "box", "min": [0,0,0], "max": [1,1,1],
                     "transform": [{"scale": 0.01}]}]})"));
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].pointer == "/shapes/a~1b/children/0");
  CHECK(faults[1].pointer == "/shapes/a~1b/children/1");
  CHECK(faults[0].message ==
        "the sphere of \"o\" reaches beyond 1e18, where /objects/1/csg uses it");
}

TEST_CASE("an eye or a light beyond the range is an error") {
  Scene scene = scene_of("");
  scene.settings.camera.eye = {0, 0, -1e19};
  scene.settings.lights.assign(2, PointLight{{1, 2, 3}, {1, 1, 1}, Falloff::kNone});
  scene.settings.lights[1].position.y = 1e200;
  const auto faults = faults_of(scene);
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].pointer == "/camera/eye");
  CHECK(faults[0].message == "the eye lies beyond 1e18");
  CHECK(faults[1].pointer == "/lights/1/position");
}

TEST_CASE("thin and wide solids that are turned are solids, as every axis of theirs is sound") {
  for (const char* solid :
       {R"({"type": "cylinder", "base": [1,1,1], "top": [4,5,7], "radius": 1e-10})",
        R"({"type": "cylinder", "base": [-1,0,0], "top": [1,0,0], "radius": 1e16, )"
        R"("transform": [{"rotate": {"axis": [0,1,0], "angle": 20}}]})",
        R"({"type": "cone", "base": [-1,0,0], "base_radius": 1e15, "top": [1,0,0], )"
        R"("top_radius": 1, "transform": [{"rotate": {"axis": [0,1,1], "angle": 20}}]})",
        R"({"type": "box", "min": [0,0,0], "max": [1e15,1,1], )"
        R"("transform": [{"rotate": {"axis": [0,1,1], "angle": 20}}]})",
        R"({"type": "ellipsoid", "center": [0,0,0], "axes": [[1e15,0,0],[0,1,0],[0,0,1]], )"
        R"("transform": [{"rotate": {"axis": [0,1,1], "angle": 20}}]})"}) {
    INFO(solid);
    CHECK(faults_of(scene_of(object(solid))).empty());
  }
}

TEST_CASE("faults beyond the limit are counted") {
  const std::string far = object(R"({"type": "sphere", "center": [0,2e18,0], "radius": 1})");
  std::string objects = far;
  for (std::size_t i = 0; i < kMaxSceneFaults + 4; ++i) objects += "," + far;
  const auto faults = faults_of(scene_of(objects));
  REQUIRE(faults.size() == kMaxSceneFaults + 1);
  CHECK(faults.back().message == "and 5 more");
}
