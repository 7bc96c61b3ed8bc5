#include "formats/graycube/write_scene.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "random_scene.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::RandomScene;
using graycube::testing::SceneText;

TEST_CASE("a written scene reads back equal, to the last bit of every number") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Scene scene = RandomScene(seed).make();
    const std::string text = write_scene_text(scene);
    INFO("seed " << seed << "\n" << text);
    const ReadResult result = read_scene_text(text);
    for (const auto& e : result.errors) UNSCOPED_INFO(e.pointer + ": " + e.message);
    REQUIRE(result.scene);
    REQUIRE(*result.scene == scene);
    REQUIRE(write_scene_text(*result.scene) == text);
  }
}

TEST_CASE("a written scene is JSON to others too") {
  for (std::uint64_t seed = 1000; seed < 1050; ++seed) {
    INFO("seed " << seed);
    REQUIRE(nlohmann::json::accept(write_scene_text(RandomScene(seed).make())));
  }
}

TEST_CASE("objects are written one to a line") {
  const auto lines = [](int objects) {
    std::string list;
    for (int i = 0; i < objects; ++i)
      list += std::string(i > 0 ? "," : "") +
              R"({"material": "red", "csg": {"type": "union", "children": [
        {"type": "ref", "shape": "ball"}, {"type": "ref", "shape": "ball", "transform": [{"scale": 2}]}]}})";
    const auto scene = read_scene_text(SceneText().with("objects", "[" + list + "]").text()).scene;
    const std::string text = write_scene_text(scene.value());
    return std::count(text.begin(), text.end(), '\n');
  };
  REQUIRE(lines(7) == lines(2) + 5);
}

TEST_CASE("what a comparison of scenes must notice, it notices") {
  // The round trip above would prove nothing with an operator== that is always true.
  const Scene a = RandomScene(1).make();
  Scene b = a;
  b.settings.min_weight += 1;
  REQUIRE_FALSE(a == b);
  b = a;
  b.shapes.push_back({"another", {SphereShape{{0, 0, 0}, 1}, std::nullopt, 0}});
  REQUIRE_FALSE(a == b);
  Scene c = b;
  std::get<SphereShape>(c.shapes.back().node.value).radius = 2;
  REQUIRE_FALSE(b == c);
  c = b;
  c.shapes.back().node.transform = Affine{};
  REQUIRE_FALSE(b == c);
}
