// Lathes and sweeps in scene files: read, written back, refused with their place, and compiled.
#include <string>
#include <variant>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene_fault.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::SceneText;

namespace {

std::string errors_of(const std::string& csg) {
  std::string text;
  for (const SceneError& e : read_scene_text(SceneText::of_csg(csg).text()).errors)
    text += e.pointer + ": " + e.message + "\n";
  return text;
}
Scene scene_with(const std::string& csg) {
  INFO(errors_of(csg));
  auto read = read_scene_text(SceneText::of_csg(csg).text());
  REQUIRE(read.scene);
  return *std::move(read.scene);
}
const OutlineLoops& outline_of(const Scene& scene) {
  return std::get<LatheShape>(scene.objects.front().csg.value).outline;
}
std::string lathe(const std::string& loops, const std::string& more = "") {
  return R"({"type": "lathe", "outline": [)" + loops + "]" + more + "}";
}
/// A list of as many points as a loop of so many segments has.
std::string many_points(int segments) {
  std::string text = "[[0,0]";
  for (int i = 1; i < 3 * segments; ++i) text += ",[1," + std::to_string(i % 7) + "]";
  return text + "]";
}

constexpr const char* kTriangle = "[[0.5,0],[1,0],[1,1]]";

}  // namespace

TEST_CASE("a loop that ends where it begins may say so once more") {
  const Scene brief = scene_with(lathe("[[0.5,0],[1,0],[1,1]]"));
  CHECK(outline_of(brief) == outline_of(scene_with(lathe("[[0.5,0],[1,0],[1,1],[0.5,0]]"))));
  CHECK(outline_of(brief).front().size() == 3);
}

TEST_CASE("the axis closes a lathe's loop that begins and ends on it") {
  const Scene scene = scene_with(lathe("[[0,0],[1,0],[1,3],[0,3]]"));
  const OutlineLoop loop = outline_of(scene).front();
  REQUIRE(loop.size() == 6);
  CHECK(loop[3] == OutlinePoint{0, 3});
  CHECK(loop[4].x == 0);
  CHECK(loop[4].y == Approx(2));
  CHECK(loop[5].y == Approx(1));
}

TEST_CASE("lathes and sweeps read back as they were written") {
  for (const std::string& csg :
       {lathe("[[0,0],[1,0],[1,3],[0,3]]"),
        lathe(std::string(kTriangle) + ", [[0.6,0.1],[0.7,0.1],[0.7,0.2]]"),
        std::string(
            R"({"type": "sweep", "height": 2, "base": -1, "outline": [[[0,0],[1,0],[1,1]]]})"),
        std::string(
            R"({"type": "sweep", "height": 0.1, "outline": [[[-3,0],[1,0],[1,1],[-3,0]]]})")}) {
    const Scene scene = scene_with(csg);
    const ReadResult again = read_scene_text(write_scene_text(scene));
    REQUIRE(again.scene);
    CHECK(again.scene->objects == scene.objects);
  }
}

TEST_CASE("what is wrong with an outline is told with its place") {
  const auto has = [](const std::string& errors, const std::string& part) {
    INFO(errors);
    CHECK(errors.find(part) != std::string::npos);
  };
  has(errors_of(lathe("")), "/csg/outline: expected 1 to 4096 loops");
  has(errors_of(lathe("[[0,0],[1,0]]")), "/csg/outline/0: expected 3 points a segment");
  has(errors_of(lathe("[[0,0],[1,0],[1,1],[0,1],[0,2]]")), "/csg/outline/0: expected 3 points");
  has(errors_of(lathe("[[0,0],[1,0],[1,1],[0.1,1]]")),
      "/csg/outline/0: expected a last point equal to the first, or both on the axis");
  has(errors_of(R"({"type": "sweep", "height": 1, "outline": [[[0,0],[1,0],[1,1],[0,1]]]})"),
      "/csg/outline/0: expected a last point equal to the first, found");
  has(errors_of(lathe("[[0,0],[-1,0],[1,1]]")),
      "/csg/outline/0/1/0: expected a finite number >= 0");
  has(errors_of(lathe("[[0,0],[1,0,0],[1,1]]")), "/csg/outline/0/1: expected a point [r, z]");
  has(errors_of(lathe("[[0,0],[1,0],[2,0]]")),
      "/csg/outline: expected curves that go round an area");
  has(errors_of(lathe("[[1,0],[1,2],[1,1]]")),
      "/csg/outline: expected curves that go round an area");
  has(errors_of(lathe(many_points(4096))), "/csg/outline/0: expected fewer than 4096 segments");
  CHECK(errors_of(lathe(many_points(4095))).empty());
  has(errors_of(lathe(kTriangle, R"(, "height": 1)")), "/csg/height");
  has(errors_of(R"({"type": "sweep", "outline": [[[0,0],[1,0],[1,1]]]})"), "height");
  has(errors_of(R"({"type": "sweep", "height": 0, "outline": [[[0,0],[1,0],[1,1]]]})"),
      "/csg/height: expected a finite number > 0");
}

TEST_CASE("refs to one shape share its outline, which has no coordinate beyond 1") {
  const std::string shapes = R"({"foot": )" + lathe("[[0,0],[12,0],[12,3],[0,3]]") + "}";
  const std::string csg = R"({"type": "union", "children": [{"type": "ref", "shape": "foot"},
      {"type": "ref", "shape": "foot", "transform": [{"translate": [30,0,0]}]}, )" +
                          lathe(kTriangle) + "]}";
  const auto read = read_scene_text(SceneText::of_csg(csg).with("shapes", shapes).text());
  REQUIRE(read.scene);
  const Model model = compile_scene(*read.scene);
  REQUIRE(model.primitives.size() == 3);
  CHECK(model.outlines.size() == 2);
  CHECK(model.primitives[0].outline == model.primitives[1].outline);
  CHECK(model.outlines[0].loops().front()[1] == OutlinePoint{0.75, 0});
  CHECK(contains(model.primitives[1], model.data(), {38, 0, 1}));
  CHECK(!contains(model.primitives[0], model.data(), {38, 0, 1}));
  // The curve reaches three quarters of the way to its inner control points.
  CHECK(model.primitives[0].bounds.hi.x == Approx(9));
  CHECK(model.primitives[0].bounds.hi.z == Approx(3));
}

TEST_CASE("an outline that leaves the range of coordinates is refused before it is rendered") {
  for (const std::string& csg :
       {lathe("[[0,0],[1e19,0],[1e19,1e19],[0,1e19]]"),
        lathe("[[0,0],[1e-19,0],[1e-19,1e-19],[0,1e-19]]"),
        std::string(R"({"type": "sweep", "height": 1e-30, "outline": [[[0,0],[1,0],[1,1]]]})")}) {
    CHECK_THROWS_AS(compile_scene(scene_with(csg)), UnrenderableScene);
  }
}
