#include "formats/graycube/read_scene.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>

#include "catch.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::SceneText;

namespace {

Scene read(const SceneText& scene) {
  ReadResult result = read_scene_text(scene.text());
  for (const auto& e : result.errors) UNSCOPED_INFO(e.pointer + ": " + e.message);
  REQUIRE(result.scene);
  return std::move(*result.scene);
}

template <typename Shape>
Shape leaf(const std::string& json) {
  const Scene scene = read(SceneText::of_csg(json));
  return std::get<Shape>(scene.objects.at(0).csg.value);
}

Vec3 transformed(const std::string& steps, const Vec3& p) {
  const Scene scene = read(SceneText::of_csg(
      R"({"type": "sphere", "center": [0,0,0], "radius": 1, "transform": )" + steps + "}"));
  return scene.objects.at(0).csg.transform.value().point(p);
}

void require_near(const Vec3& a, const Vec3& b) {
  INFO(a.x << ' ' << a.y << ' ' << a.z);
  REQUIRE(length(a - b) < 1e-14);
}

/// A file of the test's own, gone with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("graycube-read-" + std::to_string(std::random_device()()))) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST_CASE("what a scene leaves out takes its default") {
  const Scene scene = read(SceneText().with("materials", R"({"m": {}})"));
  const RenderSettings& s = scene.settings;
  CHECK(s.background == Rgb{0, 0, 0});
  CHECK(s.ambient == Rgb{1, 1, 1});
  CHECK(s.max_depth == 5);
  CHECK(s.min_weight == 0);
  CHECK(scene.digits == 0);
  CHECK(s.image == ImageSize{8, 6, 1});
  CHECK(s.camera.handedness == Handedness::kRight);
  const Material& m = scene.materials.at(0).material;
  CHECK(m.color == Rgb{1, 1, 1});
  CHECK(m.ambient == 0.1);
  CHECK(m.diffuse == 0.9);
  CHECK(m.specular == 0);
  CHECK(m.shininess == 1);
  CHECK(m.reflect == 0);
  CHECK(m.transmit == 0);
  CHECK(m.ior == 1);
  CHECK(m.model == ShadingModel::kPhong);
}

TEST_CASE("every setting is read") {
  const Scene scene = read(
      SceneText()
          .with("image", R"({"width": 300, "height": 200, "samples": 3})")
          .with("camera",
                R"({"type": "orthographic", "eye": [1,2,3], "look_at": [4,5,7], "up": [0,0,1],
                              "width": 12.5, "handedness": "left"})")
          .with("background", "[0.25,0.5,2]")
          .with("ambient", "[0.5,1,0]")
          .with("max_depth", "12")
          .with("min_weight", "0.125")
          .with("digits", "6")
          .with(
              "lights",
              R"([{"type": "point", "position": [1,2,3], "color": [4,5,6], "falloff": "inverse_square"},
                              {"type": "point", "position": [0,0,9], "shadows": false},
                              {"type": "point", "position": [0,0,9], "shadows": true,
                               "direction": [0,3,0], "angle": 22.5}])")
          .with(
              "materials",
              R"({"all": {"color": [1,2,3], "ambient": 4, "diffuse": 5, "specular": 6, "shininess": 7,
                                 "reflect": 8, "transmit": 0.5, "ior": 1.5},
                                 "hall": {"model": "hall_greenberg", "transmit": 0.5, "ior": 1.7,
                                          "shininess": 30, "attenuation": [0.1,0,2]},
                                 "rt": {"model": "rt"}, "lamp": {"model": "rt_lamp"},
                                 "camo": {"pattern": {"type": "camouflage",
                                   "colors": [[1,0,0], [0,1,0], [0,0,1]],
                                   "to_pattern": [{"scale": 2}, {"translate": [1,0,0]}],
                                   "thresholds": [-0.5, 0.75],
                                   "octaves": 3.5, "lacunarity": 2, "decay": -0.5}},
                                 "marble": {"pattern": {"type": "marble",
                                   "colors": [[1,0,0]]}}})"));
  const RenderSettings& s = scene.settings;
  CHECK(s.image == ImageSize{300, 200, 3});
  CHECK(
      s.camera ==
      Camera{
          Projection::kOrthographic, {1, 2, 3}, {4, 5, 7}, {0, 0, 1}, 0, 12.5, Handedness::kLeft});
  CHECK(s.background == Rgb{0.25, 0.5, 2});
  CHECK(s.ambient == Rgb{0.5, 1, 0});
  CHECK(s.max_depth == 12);
  CHECK(s.min_weight == 0.125);
  CHECK(scene.digits == 6);
  REQUIRE(s.lights.size() == 3);
  CHECK(s.lights[0] == PointLight{{1, 2, 3}, {4, 5, 6}, Falloff::kInverseSquare});
  CHECK(s.lights[1] == PointLight{{0, 0, 9}, {1, 1, 1}, Falloff::kNone, false});
  CHECK(s.lights[2] == PointLight{{0, 0, 9}, {1, 1, 1}, Falloff::kNone, true, {0, 3, 0}, 22.5});
  REQUIRE(scene.materials.size() == 6);
  const Pattern& camo = scene.materials[4].material.pattern;
  CHECK(camo.kind == PatternKind::kCamouflage);
  CHECK(camo.colors == std::array<Rgb, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  CHECK(camo.to_pattern == compose(translation({1, 0, 0}), scaling({2, 2, 2})));
  CHECK(camo.thresholds == std::array<double, 2>{-0.5, 0.75});
  CHECK(camo.octaves == NoiseOctaves{3.5, 2, -0.5});
  const Pattern& marble = scene.materials[5].material.pattern;
  CHECK(marble.kind == PatternKind::kMarble);
  CHECK(marble.colors[0] == Rgb{1, 0, 0});
  CHECK(marble.octaves == NoiseOctaves{});
  CHECK(scene.materials[0].material ==
        Material{{1, 2, 3}, 4, 5, 6, 7, 8, 0.5, 1.5, ShadingModel::kPhong});
  const Material& hall = scene.materials[1].material;
  CHECK(hall.model == ShadingModel::kHallGreenberg);
  CHECK(hall.ior == 1.7);
  CHECK(hall.optics == Optics{{1.7, 1.7, 1.7}, {0, 0, 0}, {0.1, 0, 2}, 0.2, 30});
  CHECK(scene.materials[2].material.model == ShadingModel::kRt);
  CHECK(scene.materials[3].material.model == ShadingModel::kRtLamp);
}

TEST_CASE("models with Fresnel's equations have an index by colour, and defaults of their own") {
  const auto material = [](const std::string& text) {
    return read(SceneText().with("materials", "{\"m\": " + text + "}")).materials.at(0).material;
  };
  const Material plain = material(R"({"model": "torrance_sparrow"})");
  CHECK(plain.optics == Optics{});
  CHECK(plain.ior == 1.5);
  CHECK(plain.specular == 0);
  const Material gold = material(
      R"({"absorption": [4.1,2.3,1.9], "ior": [0.14,0.37,1.44], "roughness": 0.4, "reflect": 1,
          "model": "torrance_sparrow"})");
  CHECK(gold.optics == Optics{{0.14, 0.37, 1.44}, {4.1, 2.3, 1.9}, {0, 0, 0}, 0.4, 1});
  const Material glass = material(
      R"({"model": "hall_greenberg", "ior": 1.3, "shininess": 9, "transmit_shininess": 90,
          "attenuation": 0.25})");
  CHECK(glass.optics == Optics{{1.3, 1.3, 1.3}, {0, 0, 0}, {0.25, 0.25, 0.25}, 0.2, 90});
  CHECK(glass.shininess == 9);
}

TEST_CASE("every kind of leaf is read") {
  CHECK(leaf<SphereShape>(R"({"type": "sphere", "center": [1,2,3], "radius": 4})") ==
        SphereShape{{1, 2, 3}, 4});
  CHECK(leaf<BoxShape>(R"({"type": "box", "min": [1,2,3], "max": [4,5,6]})") ==
        BoxShape{{1, 2, 3}, {4, 5, 6}});
  CHECK(leaf<CylinderShape>(
            R"({"type": "cylinder", "base": [1,2,3], "top": [4,5,6], "radius": 7})") ==
        CylinderShape{{1, 2, 3}, {4, 5, 6}, 7});
  CHECK(
      leaf<ConeShape>(
          R"({"type": "cone", "base": [1,2,3], "base_radius": 0, "top": [4,5,6], "top_radius": 7})") ==
      ConeShape{{1, 2, 3}, 0, {4, 5, 6}, 7});
  CHECK(leaf<TorusShape>(
            R"({"type": "torus", "center": [1,2,3], "axis": [0,0,2], "major": 3, "minor": 1})") ==
        TorusShape{{1, 2, 3}, {0, 0, 2}, 3, 1});
  CHECK(leaf<HalfSpaceShape>(R"({"type": "half_space", "normal": [0,3,4], "offset": -5})") ==
        HalfSpaceShape{{0, 3, 4}, -5});
  CHECK(leaf<EllipsoidShape>(
            R"({"type": "ellipsoid", "center": [1,2,3], "axes": [[1,0,0],[0,2,0],[0,1,3]]})") ==
        EllipsoidShape{{1, 2, 3}, {{{1, 0, 0}, {0, 2, 0}, {0, 1, 3}}}});
  CHECK(leaf<PolyhedronShape>(R"({"type": "polyhedron", "planes": [[1,0,0,4],[0,2,0,5]]})") ==
        PolyhedronShape{{{{1, 0, 0}, 4}, {{0, 2, 0}, 5}}});
}

TEST_CASE("operations keep their children in order, and keys may come in any order") {
  const Scene scene = read(SceneText::of_csg(
      R"({"children": [{"radius": 1, "center": [0,0,0], "type": "sphere"}, {"shape": "ball", "type": "ref"},
          {"type": "complement", "child": {"type": "ref", "shape": "ball", "material": "glass"}}],
          "material": "glass", "type": "difference"})"));
  const CsgNode& root = scene.objects.at(0).csg;
  CHECK(root.material == 1);
  CHECK(scene.objects.at(0).material == 0);
  CHECK_FALSE(root.transform);
  const auto& difference = std::get<OperationNode>(root.value);
  CHECK(difference.operation == Operation::kDifference);
  REQUIRE(difference.children.size() == 3);
  CHECK(std::holds_alternative<SphereShape>(difference.children[0].value));
  CHECK(difference.children[0].material == kInheritMaterial);
  CHECK(std::get<ReferenceNode>(difference.children[1].value).shape == 0);
  const auto& complement = std::get<OperationNode>(difference.children[2].value);
  CHECK(complement.operation == Operation::kComplement);
  CHECK(complement.children.at(0).material == 1);
}

TEST_CASE("transforms are applied in the order of the list") {
  require_near(transformed(R"([{"translate": [1,0,0]}, {"scale": 2}])", {1, 1, 1}), {4, 2, 2});
  require_near(transformed(R"([{"scale": 2}, {"translate": [1,0,0]}])", {1, 1, 1}), {3, 2, 2});
  require_near(transformed(R"([{"scale": [1,2,-3]}])", {1, 1, 1}), {1, 2, -3});
  // The right-hand rule: a quarter turn about z takes x to y.
  require_near(transformed(R"([{"rotate": {"axis": [0,0,5], "angle": 90}}])", {1, 0, 0}),
               {0, 1, 0});
  require_near(transformed(R"([{"matrix": [[0,1,0,7],[1,0,0,8],[0,0,1,9]]}])", {1, 2, 3}),
               {9, 9, 12});
  require_near(transformed(R"([{"matrix": [[1,0,0,7],[0,1,0,8],[0,0,1,9],[0,0,0,1]]}])", {0, 0, 0}),
               {7, 8, 9});
}

TEST_CASE("an empty list of transforms is none") {
  const Scene scene = read(
      SceneText::of_csg(R"({"type": "sphere", "center": [0,0,0], "radius": 1, "transform": []})"));
  CHECK_FALSE(scene.objects.at(0).csg.transform);
}

TEST_CASE("names may hold any characters") {
  const Scene scene = read(SceneText()
                               .with("materials", R"({"a\"/~\u00e9\n": {}})")
                               .with("objects", R"([{"name": "\ud83d\ude00", "material": "a\"/~é\n",
                                     "csg": {"type": "ref", "shape": "ball"}}])"));
  CHECK(scene.materials.at(0).name == "a\"/~\xC3\xA9\n");
  CHECK(scene.objects.at(0).name == "\xF0\x9F\x98\x80");
}

TEST_CASE("a file reads as its text does") {
  const std::string text = SceneText().text();
  const TemporaryFile plain(text), marked("\xEF\xBB\xBF" + text);
  REQUIRE(read_scene_file(plain.path()).scene == read_scene_text(text).scene);
  REQUIRE(read_scene_file(marked.path()).scene == read_scene_text(text).scene);
}

TEST_CASE("a file that can't be read is an error, not an exception") {
  CHECK(read_scene_file("/nonexistent/scene.json").errors.at(0).message == "there is no such file");
  CHECK(read_scene_file(std::filesystem::temp_directory_path())
            .errors.at(0)
            .message.find("directory") != std::string::npos);
  const TemporaryFile empty("");
  CHECK(read_scene_file(empty.path()).errors.size() == 1);
}

TEST_CASE("a file beyond the size limit is refused before it is read") {
  const TemporaryFile sparse("");
  std::error_code error;
  std::filesystem::resize_file(sparse.path(), kMaxSceneBytes + 1, error);
  if (error) return;  // the file system keeps no such files
  CHECK(read_scene_file(sparse.path()).errors.at(0).message.find("larger than") !=
        std::string::npos);
}

TEST_CASE("every example scene reads without errors") {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(GRAYCUBE_SCENES)) {
    if (entry.path().extension() != ".json") continue;
    names.insert(entry.path().filename());
    const ReadResult result = read_scene_file(entry.path());
    INFO(entry.path());
    for (const auto& e : result.errors) UNSCOPED_INFO(e.pointer + ": " + e.message);
    CHECK(result.scene);
    CHECK(std::filesystem::file_size(entry.path()) < 200 * 1024);
  }
  for (const char* name : {"first.json", "mirrors.json", "glass.json", "tori.json",
                           "engine_block.json", "ortho.json", "scatter1000.json"})
    CHECK(names.count(name) == 1);
}
