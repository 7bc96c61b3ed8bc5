#include <string>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/limits.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::SceneText;

namespace {

const std::string kSphere = R"({"type": "sphere", "center": [0,0,0], "radius": 1})";

std::string ref(int shape) {
  return R"({"type": "ref", "shape": "s)" + std::to_string(shape) + "\"}";
}

/// A union of `count` times the same node.
std::string union_of(const std::string& node, int count) {
  std::string text = R"({"type": "union", "children": [)";
  for (int i = 0; i < count; ++i) text += (i > 0 ? "," : "") + node;
  return text + "]}";
}

/// A node below `levels` unions.
std::string below(const std::string& node, std::uint32_t levels) {
  std::string text = node;
  for (std::uint32_t i = 0; i < levels; ++i) text = union_of(text, 1);
  return text;
}

/// Shapes s0 = a sphere, each next one a union of `count` refs to the one before.
std::string doubling_shapes(int levels, int count) {
  std::string text = R"({"s0": )" + kSphere;
  for (int i = 1; i <= levels; ++i)
    text += ",\"s" + std::to_string(i) + "\": " + union_of(ref(i - 1), count);
  return text + "}";
}

std::string object_of(const std::string& csg) {
  return R"([{"material": "red", "csg": )" + csg + "}]";
}

std::vector<SceneError> errors_of(const SceneText& scene) {
  return read_scene_text(scene.text()).errors;
}

}  // namespace

TEST_CASE("a tree may have 256 levels and not one more") {
  REQUIRE(errors_of(SceneText::of_csg(below(kSphere, kMaxTreeDepth - 1))).empty());
  const auto errors = errors_of(SceneText::of_csg(below(kSphere, kMaxTreeDepth)));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("deeper than 256 levels") != std::string::npos);
}

TEST_CASE("levels are counted through refs") {
  const auto scene = [](std::uint32_t levels) {
    return SceneText()
        .with("shapes", R"({"s0": )" + below(kSphere, 100) + "}")
        .with("objects", object_of(below(ref(0), levels)));
  };
  // 101 levels of the shape; the ref itself gives way to it, but counts as a level of its own tree.
  REQUIRE(errors_of(scene(154)).empty());
  const auto errors = errors_of(scene(155));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("when its refs are expanded") != std::string::npos);
}

TEST_CASE("leaves are counted without expanding refs") {
  const auto scene = [](int levels, int count) {
    return SceneText()
        .with("shapes", doubling_shapes(levels, count))
        .with("objects", object_of(ref(levels)));
  };
  // 2^18 leaves are few enough, twice as many are not; 2^100 overflow every counter.
  REQUIRE(errors_of(scene(18, 2)).empty());
  auto errors = errors_of(scene(19, 2));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].pointer == "/objects/0/csg");
  CHECK(errors[0].message == "with this ref, refs make 524288 leaves, at most 262144 are accepted");
  errors = errors_of(scene(100, 2));
  REQUIRE_FALSE(errors.empty());
  CHECK(errors[0].message.find("more than 2^64 leaves") != std::string::npos);
}

TEST_CASE("the ref that goes beyond what refs may repeat is told, once") {
  const auto errors = errors_of(
      SceneText()
          .with("shapes", doubling_shapes(18, 2))
          .with("objects", object_of(union_of(kSphere, 3) + "}, {\"material\": \"red\", \"csg\": " +
                                     union_of(ref(17), 3))));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].pointer == "/objects/1/csg/children/2");
}

TEST_CASE("planes of polyhedra and nodes without leaves are counted where refs repeat them") {
  std::string planes = "[0,1,0,1]";
  for (int i = 1; i < 1024; ++i) planes += ",[0,1,0,1]";
  const auto scene = [&](const std::string& shape, int levels) {
    std::string shapes = R"({"s0": )" + shape;
    for (int i = 1; i <= levels; ++i)
      shapes += ",\"s" + std::to_string(i) + "\": " + union_of(ref(i - 1), 2);
    return SceneText().with("shapes", shapes + "}").with("objects", object_of(ref(levels)));
  };
  const std::string polyhedron = R"({"type": "polyhedron", "planes": [)" + planes + "]}";
  CHECK(errors_of(scene(polyhedron, 11)).empty());
  auto errors = errors_of(scene(polyhedron, 12));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("4194304 planes of polyhedra") != std::string::npos);
  errors = errors_of(scene(below(kSphere, 200), 16));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find(" nodes, at most 8388608") != std::string::npos);
}

TEST_CASE("unused shapes don't count towards the leaves") {
  REQUIRE(errors_of(
              SceneText().with("shapes", doubling_shapes(9, 8)).with("objects", object_of(ref(1))))
              .empty());
}

TEST_CASE("a chain of refs as long as the file is no deep recursion") {
  const auto errors = errors_of(SceneText().with("shapes", doubling_shapes(100000, 1)));
  REQUIRE_FALSE(errors.empty());
  CHECK(errors[0].message.find("deeper than 256 levels") != std::string::npos);
}

TEST_CASE("lights are limited") {
  const auto lights = [](std::uint32_t count) {
    std::string text = "[";
    for (std::uint32_t i = 0; i < count; ++i)
      text += std::string(i > 0 ? "," : "") + R"({"type": "point", "position": [0,0,0]})";
    return SceneText().with("lights", text + "]");
  };
  REQUIRE(errors_of(lights(kMaxLights)).empty());
  REQUIRE(errors_of(lights(kMaxLights + 1)).at(0).pointer == "/lights");
}

TEST_CASE("the planes of a polyhedron are limited") {
  std::string planes = "[0,1,0,1]";
  for (std::uint32_t i = 0; i < kMaxPlanes; ++i) planes += ",[0,1,0,1]";
  const auto errors =
      errors_of(SceneText::of_csg(R"({"type": "polyhedron", "planes": [)" + planes + "]}"));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("1 to 65536 planes, found an array of 65537") != std::string::npos);
}

TEST_CASE("JSON nested too deep is refused wherever it stands") {
  const auto errors = errors_of(SceneText().with("ambient", std::string(100000, '[')));
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].message.find("nest deeper than") != std::string::npos);
}
