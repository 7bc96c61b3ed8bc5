#include "formats/pov/write_pov.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include "catch.hpp"
#include "formats/graycube/random_scene.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/scene_text.hpp"

using namespace graycube;
using graycube::testing::cube_net;
using graycube::testing::RandomScene;
using graycube::testing::SceneText;

namespace {

PovScene pov_of(const SceneText& scene) {
  const auto result = read_scene_text(scene.text());
  for (const auto& e : result.errors) UNSCOPED_INFO(e.pointer + ": " + e.message);
  REQUIRE(result.scene);
  return write_pov(*result.scene);
}

void require_holds(const std::string& text, const std::string& part) {
  INFO(text);
  REQUIRE(text.find(part) != std::string::npos);
}

/// POV-Ray text of one object of material 0 with this node.
std::string csg_text(const std::string& csg) { return pov_of(SceneText::of_csg(csg)).text; }

}  // namespace

TEST_CASE("the first line of a POV-Ray scene is the command that renders it") {
  const auto text = pov_of(SceneText()).text;
  REQUIRE(text.substr(0, text.find('\n')) ==
          "// povray +INAME.pov +ONAME.png +FN16 File_Gamma=1.0 +W8 +H6 -A -D -P -GA");
}

TEST_CASE("settings become POV-Ray's, with one trace level more than max_depth") {
  const auto text = pov_of(SceneText().with("max_depth", "7").with("ambient", "[1,0.5,0]")).text;
  require_holds(text,
                "global_settings { assumed_gamma 1.0 max_trace_level 8 adc_bailout 0 ambient_light "
                "rgb <1,0.5,0> }");
}

TEST_CASE("handedness decides where the picture's right is") {
  const auto camera = [](const std::string& handedness) {
    return pov_of(
               SceneText().with(
                   "camera",
                   R"({"type": "orthographic", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,3,1],
                                       "width": 4, "handedness": ")" +
                       handedness + "\"}"))
        .text;
  };
  require_holds(camera("right"), "direction <0,0,1> right <-4,0,0> up <0,3,0>");
  require_holds(camera("left"), "direction <0,0,1> right <4,0,0> up <0,3,0>");
}

TEST_CASE("a beam is a spotlight as bright everywhere within its cone") {
  const auto text = pov_of(SceneText().with("lights", R"([{"type": "point", "position": [1,2,3],
                                              "direction": [0,0,-4], "angle": 30}])"))
                        .text;
  require_holds(text, "spotlight radius 30 falloff 30 tightness 0 point_at <1,2,0> }");
}

TEST_CASE("every leaf has its POV-Ray object") {
  require_holds(csg_text(R"({"type": "sphere", "center": [1,2,3], "radius": 4})"),
                "sphere { <1,2,3>, 4 texture { M0 } }");
  require_holds(csg_text(R"({"type": "box", "min": [1,2,3], "max": [4,5,6]})"),
                "box { <1,2,3>, <4,5,6> ");
  require_holds(csg_text(R"({"type": "cylinder", "base": [1,2,3], "top": [4,5,6], "radius": 7})"),
                "cylinder { <1,2,3>, <4,5,6>, 7 ");
  require_holds(
      csg_text(
          R"({"type": "cone", "base": [1,2,3], "base_radius": 0, "top": [4,5,6], "top_radius": 7})"),
      "cone { <1,2,3>, 0, <4,5,6>, 7 ");
  require_holds(csg_text(R"({"type": "half_space", "normal": [0,3,4], "offset": -5})"),
                "plane { <0,0.6,0.8>, -1 ");
  require_holds(
      csg_text(R"({"type": "ellipsoid", "center": [1,2,3], "axes": [[4,0,0],[0,5,0],[0,1,6]]})"),
      "sphere { <0,0,0>, 1 matrix <4,0,0,0,5,0,0,1,6,1,2,3> ");
  require_holds(csg_text(R"({"type": "polyhedron", "planes": [[2,0,0,4],[0,1,0,5]]})"),
                "intersection {\nplane { <1,0,0>, 2 }\nplane { <0,1,0>, 5 } texture");
}

TEST_CASE("a torus lies about its axis") {
  // The middle row of the matrix is the image of POV-Ray's own axis, y.
  require_holds(
      csg_text(R"({"type": "torus", "center": [7,8,9], "axis": [0,0,2], "major": 3, "minor": 1})"),
      "torus { 3, 1 matrix <1,0,0,0,0,1,0,-1,0,7,8,9> ");
}

TEST_CASE("matrices are transposed, and follow the node's own placement") {
  require_holds(csg_text(R"({"type": "sphere", "center": [0,0,0], "radius": 1,
                             "transform": [{"matrix": [[1,2,3,4],[0,1,5,6],[0,0,1,7]]}]})"),
                "sphere { <0,0,0>, 1 matrix <1,0,0,2,1,0,3,5,1,4,6,7> texture { M0 } }");
}

TEST_CASE("a complement is its child inverted") {
  require_holds(
      csg_text(
          R"({"type": "complement", "child": {"type": "sphere", "center": [0,0,0], "radius": 1}})"),
      "object { sphere { <0,0,0>, 1 } inverse texture { M0 } }");
}

TEST_CASE("shapes are declared before they are used") {
  const auto text =
      pov_of(
          SceneText()
              .with("shapes", R"({"late": {"type": "union", "children": [{"type": "ref", "shape":
                                     "early"}, {"type": "ref", "shape": "early"}]}, "early": {"type": "sphere",
                                     "center": [0,0,0], "radius": 1}})")
              .with("objects", R"([{"material": "red", "csg": {"type": "ref", "shape": "late"}}])"))
          .text;
  REQUIRE(text.find("#declare S1") < text.find("#declare S0"));
  require_holds(text, "union {\nobject { S1 }\nobject { S1 } }");
  require_holds(text, "object { S0 texture { M0 } }");
}

TEST_CASE("a use doesn't paint over a shape's own material") {
  const auto text =
      pov_of(SceneText()
                 .with("shapes", R"({"s": {"type": "sphere", "center": [0,0,0], "radius": 1,
                                     "material": "glass"}, "t": {"type": "ref", "shape": "s"}})")
                 .with("objects", R"([{"material": "red", "csg": {"type": "ref", "shape": "t"}}])"))
          .text;
  require_holds(text, "\nobject { S1 }\n");
}

TEST_CASE("a repeat's child is declared once, and used under each product of its maps") {
  const std::string text = csg_text(
      R"({"type": "repeat", "depth": 2, "maps": [[{"translate": [1,0,0]}], [{"scale": 2}]],
          "child": {"type": "sphere", "center": [0,0,0], "radius": 0.25}})");
  require_holds(text, "#declare R0 =\nsphere { <0,0,0>, 0.25 }\n");
  require_holds(text,
                "union {\nobject { R0 }\n"
                "object { R0 matrix <1,0,0,0,1,0,0,0,1,1,0,0> }\n"
                "object { R0 matrix <1,0,0,0,1,0,0,0,1,2,0,0> }\n"
                "object { R0 matrix <2,0,0,0,2,0,0,0,2,1,0,0> }\n"
                "object { R0 matrix <2,0,0,0,2,0,0,0,2,0,0,0> }\n"
                "object { R0 matrix <2,0,0,0,2,0,0,0,2,2,0,0> }\n"
                "object { R0 matrix <4,0,0,0,4,0,0,0,4,0,0,0> } texture { M0 } }");
  // One copy needs no union, and keeps the texture that its child has.
  require_holds(
      csg_text(R"({"type": "repeat", "depth": 2, "keep": "last", "maps": [[{"scale": 2}]], "child":
          {"type": "sphere", "center": [0,0,0], "radius": 0.25, "material": "glass"}})"),
      "object { R0 matrix <4,0,0,0,4,0,0,0,4,0,0,0> }\n");
}

TEST_CASE("the eye may be in a copy of a repeat: then inner surfaces show") {
  const auto text = [](const std::string& depth) {
    return csg_text(R"({"type": "repeat", "maps": [[{"translate": [0,0,-1]}]], "child":
        {"type": "sphere", "center": [0,0,0], "radius": 0.75}, "depth": )" +
                    depth + "}");
  };
  require_holds(text("4"), "union {");
  require_holds(text("5"), "merge {");
}

TEST_CASE("a net of patches is written as its mesh") {
  Scene scene = *read_scene_text(SceneText().text()).scene;
  const auto text = [&](double tolerance) {
    scene.objects = {{"", 0, {BezierShape{cube_net(), tolerance}, {}, kInheritMaterial}}};
    return write_pov(scene).text;
  };
  require_holds(text(0), "mesh2 { vertex_vectors { 8, <");
  require_holds(text(0), " } face_indices { 12, <");
}

TEST_CASE("lathes and sweeps are written as POV-Ray's, exactly") {
  require_holds(csg_text(R"({"type": "lathe", "outline": [[[0,0],[1,0],[1,3],[0,3]]]})"),
                "lathe { bezier_spline 4, <0,0>, <1,0>, <1,3>, <0,3> sturm matrix "
                "<1,0,0,0,0,1,0,1,0,0,0,0>");
  require_holds(
      csg_text(R"({"type": "sweep", "height": 2, "base": -0.5, "outline": [[[0,0],[1,0],[1,1]]]})"),
      "prism { linear_sweep bezier_spline -0.5, 1.5, 4, <0,0>, <1,0>, <1,1>, <0,0> matrix "
      "<1,0,0,0,0,1,0,1,0,0,0,0>");
}

TEST_CASE("unions are merges where their inner surfaces could be seen") {
  const std::string objects = R"([{"material": "red", "csg": {"type": "union", "children": [
      {"type": "sphere", "center": [0,0,0], "radius": RADIUS}, {"type": "sphere", "center": [1,0,0], "radius": 1}]}}])";
  const auto with_radius = [&](const std::string& radius) {
    std::string text = objects;
    return text.replace(text.find("RADIUS"), 6, radius);
  };
  // The eye is at distance 5.
  require_holds(pov_of(SceneText().with("objects", with_radius("1"))).text, "union {");
  require_holds(pov_of(SceneText().with("objects", with_radius("6"))).text, "merge {");
  require_holds(pov_of(SceneText()
                           .with("objects", with_radius("1"))
                           .with("materials", R"({"red": {"transmit": 0.5}})"))
                    .text,
                "merge {");
}

TEST_CASE("transparent materials carry an interior") {
  const auto text =
      pov_of(SceneText::of_csg(R"({"type": "ref", "shape": "ball"})")
                 .with("materials", R"({"red": {"transmit": 0.5, "ior": 1.25, "reflect": 0.125}})"))
          .text;
  require_holds(text,
                "pigment { rgbt <1,1,1,0.5> } finish { ambient 0.1 diffuse 0.9 phong 0 phong_size "
                "1 reflection { 0.125 } }");
  require_holds(text, "#declare I0 = interior { ior 1.25 }");
  require_holds(text, "object { S0 texture { M0 } interior { I0 } }");
}

TEST_CASE("what POV-Ray can't compute is told") {
  REQUIRE(pov_of(SceneText()).warnings.empty());
  const auto warned = [](const std::string& key, const std::string& json,
                         const std::string& fragment) {
    const auto warnings = pov_of(SceneText().with(key, json)).warnings;
    REQUIRE(warnings.size() == 1);
    require_holds(warnings[0], fragment);
  };
  warned("materials", R"({"m": {"model": "torrance_sparrow"}})",
         "material \"m\": POV-Ray has no torrance_sparrow");
  warned("materials", R"({"m": {"model": "hall_greenberg"}})", "hall_greenberg");
  warned("image", R"({"width": 8, "height": 6, "samples": 2})", "2 times as large");
  warned("materials", R"({"m": {"pattern": {"type": "marble", "colors": [[1,0,0]]}}})",
         "its pattern is left out");
  warned("lights",
         R"([{"type": "point", "position": [0,0,0], "direction": [0,0,1], "angle": 120}])",
         "wider than POV-Ray's spotlights");
  warned("min_weight", "0.25", "adc_bailout");
  warned("max_depth", "256", "at most 256 generations");
}

TEST_CASE("materials of models that POV-Ray doesn't have become the most alike of Phong's") {
  const auto finish_of = [](const std::string& material) {
    return pov_of(SceneText::of_csg(R"({"type": "ref", "shape": "ball"})")
                      .with("materials", "{\"red\": " + material + "}"))
        .text;
  };
  // Index 3 mirrors a quarter of what falls straight on it; 1 / (4 m²) is 4 and 1 / (2 m²) is 8.
  require_holds(finish_of(R"({"model": "torrance_sparrow", "ior": 3, "roughness": 0.25,
                              "specular": 0.5, "reflect": 0.5})"),
                "phong 0.5 phong_size 8 reflection { 0.125 } }");
  const std::string glass = finish_of(R"({"model": "hall_greenberg", "ior": 3, "specular": 1,
                                          "shininess": 100, "transmit": 0.5})");
  require_holds(glass, "rgbt <1,1,1,0.375>");
  require_holds(glass, "phong 0.25 phong_size 25 }");
  require_holds(glass, "interior { ior 3 }");
}

TEST_CASE("braces balance whatever the scene, and names stay in their comments") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string text = write_pov(RandomScene(seed).make()).text;
    INFO("seed " << seed << "\n" << text);
    REQUIRE(std::count(text.begin(), text.end(), '{') == std::count(text.begin(), text.end(), '}'));
    REQUIRE(text.find('\x01') == std::string::npos);
    REQUIRE(text.find("nan") == std::string::npos);
    REQUIRE(text.find("inf") == std::string::npos);
  }
}
