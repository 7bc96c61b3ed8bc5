// Repeats in scene files: what is read, what is wrong, and that their copies are counted before any
// is made.
#include <string>
#include <vector>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "scene/limits.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::SceneText;

namespace {

const std::string kSphere = R"({"type": "sphere", "center": [0,0,0], "radius": 1})";
const std::string kMap = R"([{"scale": 0.5}, {"translate": [1,0,0]}])";

/// A repeat under so many equal maps; `keep` may be empty.
std::string repeat_of(const std::string& child, int maps, int depth, const std::string& keep = "") {
  std::string text = R"({"type": "repeat", "child": )" + child + R"(, "maps": [)";
  for (int i = 0; i < maps; ++i) text += (i > 0 ? "," : "") + kMap;
  text += R"(], "depth": )" + std::to_string(depth);
  return text + (keep.empty() ? "" : R"(, "keep": ")" + keep + '"') + "}";
}

std::string listed(const std::vector<SceneError>& errors) {
  std::string text;
  for (const SceneError& e : errors) text += e.pointer + ": " + e.message + "\n";
  return text;
}
/// The errors, a line for each, of a scene with one object of this solid.
std::string errors_of(const std::string& csg) {
  return listed(read_scene_text(SceneText::of_csg(csg).text()).errors);
}
std::string errors_with_shape(const std::string& shape, const std::string& csg) {
  return listed(
      read_scene_text(SceneText::of_csg(csg).with("shapes", "{\"s\": " + shape + "}").text())
          .errors);
}

}  // namespace

TEST_CASE("a repeat has the child, the maps, the depth and the copies that the file says") {
  const auto read = read_scene_text(
      SceneText::of_csg(R"({"type": "repeat", "child": )" + kSphere + R"(, "depth": 3, "maps":
        [[{"scale": 2}, {"translate": [1,0,0]}], [], [{"translate": [0,5,0]}]],
        "transform": [{"translate": [0,0,7]}]})")
          .text());
  INFO(listed(read.errors));
  REQUIRE(read.scene);
  const CsgNode& node = read.scene->objects[0].csg;
  const auto& repeat = std::get<RepeatNode>(node.value);
  REQUIRE(repeat.child.size() == 1);
  CHECK(std::get<SphereShape>(repeat.child.front().value).radius == 1);
  CHECK(repeat.depth == 3);
  CHECK(repeat.kept == KeptCopies::kAll);
  REQUIRE(repeat.maps.size() == 3);
  CHECK(repeat.maps[0].point({1, 1, 1}) == Vec3{3, 2, 2});
  CHECK(repeat.maps[1] == Affine{});
  CHECK(repeat.maps[2].point({1, 1, 1}) == Vec3{1, 6, 1});
  CHECK(node.transform->translation() == Vec3{0, 0, 7});
}

TEST_CASE("a repeat that is written reads back as it was") {
  for (const char* keep : {"all", "last"}) {
    const auto read = read_scene_text(
        SceneText::of_csg(repeat_of(repeat_of(kSphere, 2, 0, keep), 3, 4, keep)).text());
    REQUIRE(read.scene);
    const std::string text = write_scene_text(*read.scene);
    INFO(text);
    const auto again = read_scene_text(text);
    REQUIRE(again.scene);
    CHECK(*again.scene == *read.scene);
    CHECK((text.find("\"keep\": \"last\"") != std::string::npos) == (std::string(keep) == "last"));
  }
}

TEST_CASE("what is wrong with a repeat is told with its place") {
  const std::string csg = "/objects/0/csg";
  CHECK(errors_of(repeat_of(kSphere, 1, 1, "lats")) ==
        csg + "/keep: unknown word \"lats\"; did you mean \"last\"?\n");
  CHECK(errors_of(R"({"type": "repaet", "child": {}})").find("did you mean \"repeat\"?") !=
        std::string::npos);
  CHECK(errors_of(R"({"type": "repeat", "chidl": {}})").find("did you mean \"child\"?") !=
        std::string::npos);
  CHECK(errors_of(repeat_of(kSphere, 0, 1)).starts_with(csg + "/maps: expected one map or more"));
  CHECK(
      errors_of(repeat_of(kSphere, 1, kMaxRepeatDepth + 1)).starts_with(csg + "/depth: expected"));
  CHECK(errors_of(repeat_of(kSphere, 1, -1)).starts_with(csg + "/depth: expected"));
  CHECK(errors_of(R"({"type": "repeat", "child": )" + kSphere +
                  R"(, "maps": [[{"scale": 1}], [{"scale": 0}], {"scale": 2}], "depth": 1})")
            .starts_with(csg +
                         "/maps/1/0/scale: expected scale factors that are not zero, found 0\n" +
                         csg + "/maps/2: expected"));
  CHECK(errors_of(R"({"type": "repeat"})") == csg + ": a repeat needs the key \"child\"\n" + csg +
                                                  ": a repeat needs the key \"maps\"\n" + csg +
                                                  ": a repeat needs the key \"depth\"\n");
}

TEST_CASE("a leaf without a material in a repeat is told once") {
  const auto read = read_scene_text(
      SceneText().with("objects", R"([{"csg": )" + repeat_of(kSphere, 3, 3) + "}]").text());
  CHECK(listed(read.errors).starts_with("/objects/0/csg/child: a sphere without a material"));
  CHECK(read.errors.size() == 1);
}

TEST_CASE("copies are counted before they are made") {
  // 2^18 − 1 and 2^18 copies; the child itself is spelled out.
  CHECK(errors_of(repeat_of(kSphere, 2, 17)).empty());
  CHECK(errors_of(repeat_of(kSphere, 2, 18, "last")).empty());
  CHECK(errors_of(repeat_of(kSphere, 2, 18)) ==
        "/objects/0/csg: with this repeat, refs and repeats make 524286 leaves, at most 262144 are "
        "accepted\n");
  CHECK(errors_of(repeat_of(kSphere, 2, 19, "last")).find("524287 leaves") != std::string::npos);
  CHECK(errors_of(repeat_of(kSphere, 100, 256)).find("more than 2^64 leaves") != std::string::npos);
}

TEST_CASE("copies of copies, and shapes that are copied, are counted together") {
  const std::string two = repeat_of(repeat_of(kSphere, 2, 8), 2, 7);  // 255 × 511 leaves
  CHECK(errors_of(two).empty());
  const std::string three =
      R"({"type": "union", "children": [)" + two + "," + two + "," + two + "]}";
  CHECK(errors_of(three).starts_with("/objects/0/csg/children/2: with this repeat, "));
  CHECK(errors_of(repeat_of(repeat_of(kSphere, 2, 21), 2, 2))
            .starts_with("/objects/0/csg/child: with this repeat, "));
  const std::string ref = R"({"type": "ref", "shape": "s"})";
  CHECK(errors_with_shape(two, ref).empty());
  CHECK(errors_with_shape(two, repeat_of(ref, 1, 1)).empty());
  CHECK(
      errors_with_shape(two, repeat_of(ref, 2, 1))
          .starts_with("/objects/0/csg/child: with this ref, refs and repeats make 390915 leaves"));
}

TEST_CASE("products without copies count as nodes, so that chains of maps take no time") {
  const auto nested = [](int repeats) {
    std::string text = kSphere;
    for (int i = 0; i < repeats; ++i) text = repeat_of(text, 1, 256, "last");
    return text;
  };
  CHECK(errors_of(nested(200)).empty());
  CHECK(errors_of(repeat_of(nested(31), 2, 10, "last")).empty());
  CHECK(errors_of(repeat_of(nested(33), 2, 10, "last")).find(" nodes, at most 8388608") !=
        std::string::npos);
}

TEST_CASE("a repeat is one level of its tree") {
  const auto nested = [](std::uint32_t repeats) {
    std::string text = kSphere;
    for (std::uint32_t i = 0; i < repeats; ++i) text = repeat_of(text, 1, 1, "last");
    return text;
  };
  CHECK(errors_of(nested(kMaxTreeDepth - 1)).empty());
  CHECK(errors_of(nested(kMaxTreeDepth)).find("deeper than 256 levels") != std::string::npos);
}
