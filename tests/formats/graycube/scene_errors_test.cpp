// Every kind of error that a scene file can hold: a snippet, the place of the error, and its
// words.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::SceneText;

namespace {

struct Expectation {
  std::string pointer;
  std::string fragment;
};

std::string listed(const std::vector<SceneError>& errors) {
  std::string text;
  for (const auto& e : errors) text += e.pointer + ": " + e.message + "\n";
  return text;
}

/// Checks for exactly the expected errors, in this order.
void check_errors(const std::string& text, const std::vector<Expectation>& expected) {
  const ReadResult result = read_scene_text(text);
  INFO(text);
  INFO(listed(result.errors));
  CHECK_FALSE(result.scene);
  REQUIRE(result.errors.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(result.errors[i].pointer == expected[i].pointer);
    CHECK(result.errors[i].message.find(expected[i].fragment) != std::string::npos);
  }
}

struct Case {
  std::string json;
  std::string pointer;
  std::string fragment;
};

/// Puts each JSON value in the place of a top-level key.
void check_key(const std::string& key, const std::vector<Case>& cases) {
  for (const auto& c : cases)
    check_errors(SceneText().with(key, c.json).text(), {{c.pointer, c.fragment}});
}

/// Puts each JSON value in the place of an object's CSG node; pointers count from there.
void check_csg(const std::vector<Case>& cases) {
  for (const auto& c : cases)
    check_errors(SceneText::of_csg(c.json).text(), {{"/objects/0/csg" + c.pointer, c.fragment}});
}

const std::string kSphere = R"({"type": "sphere", "center": [0,0,0], "radius": 1})";

std::string transformed(const std::string& steps) {
  return R"({"type": "sphere", "center": [0,0,0], "radius": 1, "transform": )" + steps + "}";
}

}  // namespace

TEST_CASE("the snippet the error tests start from is valid") {
  REQUIRE(read_scene_text(SceneText().text()).errors.empty());
  REQUIRE(read_scene_text(SceneText::of_csg(kSphere).text()).errors.empty());
  REQUIRE(
      read_scene_text(SceneText::of_csg(transformed(R"([{"scale": 2}])")).text()).errors.empty());
}

TEST_CASE("every required top-level key is asked for") {
  for (const std::string key : {"graycube", "image", "camera", "lights", "objects"})
    check_errors(SceneText().without(key).text(), {{"", "a scene needs the key \"" + key + "\""}});
  for (const std::string key : {"materials", "shapes"})
    REQUIRE(read_scene_text(SceneText().without(key).text()).scene);
}

TEST_CASE("top-level values of the wrong kind are refused") {
  check_errors("[]", {{"", "expected an object, found an empty array"}});
  check_errors("3", {{"", "expected an object, found 3"}});
  check_key("graycube",
            {{"2", "/graycube", "expected 1, found 2"}, {"\"1\"", "/graycube", "found \"1\""}});
  check_key("background",
            {{"[0,-1,0]", "/background/1", "expected a finite number >= 0, found -1"},
             {"[0,0]", "/background", "expected a colour [red, green, blue], found [0,0]"},
             {"0.5", "/background", "expected a colour"}});
  check_key("ambient", {{"[1,1,null]", "/ambient/2", "found null"}});
  check_key("max_depth", {{"-1", "/max_depth", "a whole number from 0 to 1000, found -1"},
                          {"2.5", "/max_depth", "found 2.5"},
                          {"1001", "/max_depth", "found 1001"}});
  check_key("digits", {{"0", "/digits", "a whole number from 1 to 17, found 0"},
                       {"18", "/digits", "found 18"},
                       {"6.5", "/digits", "found 6.5"},
                       {"\"6\"", "/digits", "found \"6\""}});
  check_key("min_weight", {{"-0.1", "/min_weight", ">= 0"}});
  check_key("lights", {{"{}", "/lights", "expected an array, found an object"}});
  check_key("materials", {{"[]", "/materials", "expected an object"}});
  check_key("shapes", {{"true", "/shapes", "expected an object, found true"}});
  check_key("objects", {{"{}", "/objects", "expected an array"},
                        {"[3]", "/objects/0", "expected an object, found 3"}});
  check_key("colour", {{"1", "/colour", "unknown key \"colour\" of a scene"}});
  check_key("matreials", {{"{}", "/matreials", "did you mean \"materials\"?"}});
}

TEST_CASE("a bad image is refused") {
  check_key(
      "image",
      {{R"({"width": 8})", "/image", "needs the key \"height\""},
       {R"({"width": 0, "height": 8})", "/image/width", "from 1 to 16384, found 0"},
       {R"({"width": 8, "height": 16385})", "/image/height", "found 16385"},
       {R"({"width": 8, "height": 8, "samples": 65})", "/image/samples", "from 1 to 64"},
       {R"({"width": 16384, "height": 16384})", "/image", "at most 67108864 pixels"},
       {R"({"width": 8, "heigth": 3, "height": 8})", "/image/heigth", "did you mean \"height\"?"}});
}

TEST_CASE("a degenerate camera is refused") {
  const auto camera = [](const std::string& rest) {
    return R"({"type": "perspective", )" + rest + "}";
  };
  const auto ortho = [](const std::string& rest) {
    return R"({"type": "orthographic", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0])" + rest +
           "}";
  };
  const std::string frame = R"("eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0])";
  check_key(
      "camera",
      {{camera(R"("eye": [1,2,3], "look_at": [1,2,3], "up": [0,1,0], "fov": 40)"),
        "/camera/look_at", "non-zero distance from the eye, found [1,2,3]"},
       {camera(R"("eye": [0,0,-5], "look_at": [0,0,0], "up": [0,0,-3], "fov": 40)"), "/camera/up",
        "not along the view"},
       {camera(R"("eye": [0,0,-5], "look_at": [0,0,0], "up": [0,0,0], "fov": 40)"), "/camera/up",
        "non-zero"},
       {camera(R"("look_at": [0,0,0], "up": [0,1,0], "fov": 40)"), "/camera",
        "needs the key \"eye\""},
       {camera(frame + R"(, "fov": 0)"), "/camera/fov", "between 0 and 180 degrees, found 0"},
       {camera(frame + R"(, "fov": 180)"), "/camera/fov", "found 180"},
       {camera(frame), "/camera", "a perspective camera needs the key \"fov\""},
       {camera(frame + R"(, "fov": 40, "pixel_offset": 0.5)"), "/camera/pixel_offset",
        "two numbers from 0 to 1, found 0.5"},
       {camera(frame + R"(, "fov": 40, "pixel_offset": [0, 1.5])"), "/camera/pixel_offset/1",
        "a number from 0 to 1, found 1.5"},
       {camera(frame + R"(, "fov": 40, "inside": "entry")"), "/camera/inside",
        "only an orthographic camera"},
       {camera(frame + R"(, "fov": 40, "handedness": "rigth")"), "/camera/handedness",
        "did you mean \"right\"?"},
       {camera(frame + R"(, "fov": 40, "width": 2)"), "/camera/width", "did you mean \"fov\"?"},
       {"{" + frame + R"(, "fov": 40})", "/camera", "needs the key \"type\""},
       {ortho(""), "/camera", "an orthographic camera needs the key \"width\""},
       {ortho(R"(, "width": 0)"), "/camera/width", "a finite number > 0, found 0"},
       {ortho(R"(, "width": 2, "fov": 30)"), "/camera/fov", "did you mean \"width\"?"},
       {R"({"type": "fisheye", )" + frame + "}", "/camera/type",
        "known are \"perspective\" and \"orthographic\""}});
}

TEST_CASE("a bad light is refused") {
  check_key(
      "lights",
      {{R"([{"type": "point"}])", "/lights/0", "a light needs the key \"position\""},
       {R"([{"type": "pont", "position": [0,0,0]}])", "/lights/0/type", "did you mean \"point\"?"},
       {R"([{"position": [0,0,0]}])", "/lights/0", "needs the key \"type\""},
       {R"([{"type": "point", "position": [0,0,0], "color": [1,1,-1]}])", "/lights/0/color/2",
        ">= 0"},
       {R"([{"type": "point", "position": [0,0,0], "shadows": 0}])", "/lights/0/shadows",
        "true or false"},
       {R"([{"type": "point", "position": [0,0,0], "falloff": "linear"}])", "/lights/0/falloff",
        "unknown word \"linear\""},
       {R"([{"type": "point", "position": [0,0,0], "angle": 30}])", "/lights/0",
        "a beam needs the keys \"direction\" and \"angle\""},
       {R"([{"type": "point", "position": [0,0,0], "direction": [0,0,1]}])", "/lights/0",
        "a beam needs the keys \"direction\" and \"angle\""},
       {R"([{"type": "point", "position": [0,0,0], "direction": [0,0,0], "angle": 30}])",
        "/lights/0/direction", "length"},
       {R"([{"type": "point", "position": [0,0,0], "direction": [0,0,1], "angle": 181}])",
        "/lights/0/angle", "an angle from 0 to 180 degrees, found 181"}});
}

TEST_CASE("a bad material is refused") {
  const auto bad = [](const std::string& member, const std::string& key,
                      const std::string& fragment) {
    return Case{R"({"red": {)" + member + "}}", "/materials/red/" + key, fragment};
  };
  check_key(
      "materials",
      {bad(R"("color": [0,0,-0.5])", "color/2", "found -0.5"),
       bad(R"("ambient": -1)", "ambient", ">= 0"), bad(R"("diffuse": -1)", "diffuse", ">= 0"),
       bad(R"("specular": -1)", "specular", ">= 0"), bad(R"("shininess": -1)", "shininess", ">= 0"),
       bad(R"("reflect": -1)", "reflect", ">= 0"),
       bad(R"("transmit": 1.5)", "transmit", "a number from 0 to 1, found 1.5"),
       bad(R"("transmit": -0.5)", "transmit", "from 0 to 1"),
       bad(R"("ior": 0)", "ior", "> 0, found 0"),
       bad(R"("model": "fong")", "model", "did you mean \"phong\"?"),
       bad(R"("diffuse": 1e999)", "diffuse", "found 1e999"),
       bad(R"("colour": [1,1,1])", "colour", "did you mean \"color\"?"),
       bad(R"("difuse": 1)", "difuse", "did you mean \"diffuse\"?"),
       bad(R"("model": "hall_greenburg")", "model", "did you mean \"hall_greenberg\"?")});
}

TEST_CASE("numbers beyond what a model means, and keys of other models, are refused") {
  const auto bad = [](const std::string& model, const std::string& member, const std::string& key,
                      const std::string& fragment) {
    return Case{R"({"red": {"model": ")" + model + "\", " + member + "}}", "/materials/red/" + key,
                fragment};
  };
  const std::string phong = "phong", facets = "torrance_sparrow", hall = "hall_greenberg";
  check_key(
      "materials",
      {bad(facets, R"("specular": 1.5)", "specular", "a number from 0 to 1, found 1.5"),
       bad(hall, R"("diffuse": 2)", "diffuse", "from 0 to 1"),
       bad(hall, R"("reflect": 1.01)", "reflect", "from 0 to 1"),
       bad(facets, R"("roughness": 0)", "roughness", "a number from 0.001 to 1, found 0"),
       bad(facets, R"("roughness": 1.5)", "roughness", "found 1.5"),
       bad(hall, R"("ior": 0)", "ior", "a number from 0.001 to 1000, found 0"),
       bad(hall, R"("ior": [1.5,1e4,1.5])", "ior/1", "a number from 0.001 to 1000, found 1"),
       bad(hall, R"("ior": [1.5,1.5])", "ior", "or three of them for red, green and blue"),
       bad(phong, R"("ior": [1.5,1.5,1.5])", "ior", "a finite number > 0"),
       bad(facets, R"("absorption": -1)", "absorption", "a number from 0 to 1000"),
       bad(hall, R"("attenuation": [1,-1,0])", "attenuation/1", ">= 0"),
       bad(hall, R"("transmit_shininess": -1)", "transmit_shininess", ">= 0"),
       bad(hall, R"("transmit": 0.5, "ior": [1.5,1.6,1.5])", "ior", "expected one number"),
       bad(facets, R"("transmit": 0.5, "absorption": [0,0,1])", "absorption",
           "to dim light on its way inside use \"attenuation\""),
       bad(facets, R"("shininess": 20)", "shininess",
           "the model \"torrance_sparrow\" has no key \"shininess\"; did you mean \"roughness\"?"),
       bad(phong, R"("roughness": 0.2)", "roughness", "did you mean \"shininess\"?"),
       bad("rt", R"("absorption": 2)", "absorption",
           "it belongs to \"torrance_sparrow\" and \"hall_greenberg\""),
       bad(facets, R"("attenuation": 1)", "attenuation", "it belongs to \"hall_greenberg\""),
       bad(phong, R"("transmit_shininess": 1)", "transmit_shininess",
           "it belongs to \"hall_greenberg\"")});
}

TEST_CASE("more media than a ray's record has numbers for are refused") {
  const auto with_media = [](std::size_t count) {
    std::string text = "{";
    for (std::size_t i = 0; i < count; ++i)
      text += (i == 0 ? "\"m" : ", \"m") + std::to_string(i) +
              "\": {\"model\": \"hall_greenberg\", \"attenuation\": 1}";
    return SceneText().with("materials", text + "}").text();
  };
  CHECK(read_scene_text(with_media(kMaxMedia)).scene);
  check_errors(with_media(kMaxMedia + 1),
               {{"/materials", "expected at most 255 materials with \"attenuation\", found 256"}});
}

TEST_CASE("a bad pattern is refused") {
  const auto bad = [](const std::string& pattern, const std::string& key,
                      const std::string& fragment) {
    return Case{R"({"red": {"pattern": {)" + pattern + "}}}", "/materials/red/pattern" + key,
                fragment};
  };
  const std::string camo = R"("type": "camouflage", "colors": [[1,0,0], [0,1,0], [0,0,1]])";
  check_key(
      "materials",
      {bad(R"("colors": [[1,0,0]])", "", "a pattern needs the key \"type\""),
       bad(R"("type": "marble")", "", "a pattern needs the key \"colors\""),
       bad(R"("type": "marbel", "colors": [])", "/type", "did you mean \"marble\"?"),
       bad(R"("type": "marble", "colors": [[1,0,0], [0,0,1]])", "/colors", "a list of 1 colour"),
       bad(R"("type": "checker", "colors": [[1,0,0]])", "/colors", "a list of 2 colours"),
       bad(R"("type": "checker", "colors": [[1,0,0], [0,0,-1]])", "/colors/1/2", ">= 0"),
       bad(R"("type": "checker", "colors": [[1,0,0], [0,0,1]], "octaves": 3)", "/octaves",
           "a checker pattern has no key \"octaves\""),
       bad(R"("type": "marble", "colors": [[1,0,0]], "thresholds": [0, 1])", "/thresholds",
           "a marble pattern has no key \"thresholds\""),
       bad(camo + R"(, "thresholds": [0])", "/thresholds", "two numbers"),
       bad(camo + R"(, "octaves": 33)", "/octaves", "a number from 0 to 32, found 33"),
       bad(camo + R"(, "lacunarity": 0)", "/lacunarity", "> 0"),
       bad(camo + R"(, "decay": 1e999)", "/decay", "finite"),
       bad(camo + R"(, "to_pattern": [{"scale": 0}])", "/to_pattern/0/scale", "not zero")});
}

TEST_CASE("a bad chart is refused") {
  const auto bad = [](const std::string& chart, const std::string& key,
                      const std::string& fragment) {
    return Case{R"({"red": {"pattern": {"type": "marble", "colors": [[1,0,0]], "chart": {)" +
                    chart + "}}}}",
                "/materials/red/pattern/chart" + key, fragment};
  };
  const std::string round = R"("type": "round", )";
  check_key(
      "materials",
      {bad(R"("to_solid": [])", "", "a chart needs the key \"type\""),
       bad(R"("type": "spere")", "/type", "did you mean \"sphere\"?"),
       bad(R"("type": "sphere", "top_radii": [1, 1])", "/top_radii",
           "a sphere chart has no key \"top_radii\""),
       bad(R"("type": "sphere", "faces": [[]])", "/faces", "a sphere chart has no key \"faces\""),
       bad(R"("type": "faces", "faces": [[]], "to_solid": [])", "/to_solid",
           "a faces chart has no key \"to_solid\""),
       bad(R"("type": "faces")", "", "a list of 1 to 6 faces' maps"),
       bad(R"("type": "faces", "faces": [])", "/faces", "a list of 1 to 6 faces' maps"),
       bad(R"("type": "faces", "faces": [[],[],[],[],[],[],[]])", "/faces", "a list of 1 to 6"),
       bad(R"("type": "torus", "to_solid": [{"scale": 0}])", "/to_solid/0/scale", "not zero"),
       bad(round + R"("ends": ["none"])", "/ends", "what v is on both ends"),
       bad(round + R"("ends": ["none", "non"])", "/ends/1", "did you mean \"none\"?"),
       bad(round + R"("top_radii": [1, -1])", "/top_radii/1", ">= 0"),
       bad(round + R"("top_radii": 1)", "/top_radii", "two radii")});
}

TEST_CASE("every leaf's values are checked") {
  check_csg(
      {{R"({"type": "sphere", "center": [0,0,0], "radius": 0})", "/radius", "> 0, found 0"},
       {R"({"type": "sphere", "center": [0,0,0], "radius": -1})", "/radius", "found -1"},
       {R"({"type": "sphere", "center": [0,0,1e999], "radius": 1})", "/center/2",
        "finite number, found 1e999"},
       {R"({"type": "sphere", "center": [0,0], "radius": 1})", "/center",
        "a vector [x, y, z], found [0,0]"},
       {R"({"type": "sphere", "center": [0,0,0]})", "", "a sphere needs the key \"radius\""},
       {R"({"type": "box", "min": [0,0,0], "max": [1,0,1]})", "/max",
        "max.y greater than that of min [0,0,0]"},
       {R"({"type": "cylinder", "base": [1,1,1], "top": [1,1,1], "radius": 1})", "/top",
        "non-zero distance"},
       {R"({"type": "cylinder", "base": [0,0,0], "top": [0,1,0], "radius": 0})", "/radius", "> 0"},
       {R"({"type": "cone", "base": [0,0,0], "base_radius": 0, "top": [0,1,0], "top_radius": 0})",
        "/top_radius", "top_radius > 0 where base_radius is 0"},
       {R"({"type": "cone", "base": [0,0,0], "base_radius": -1, "top": [0,1,0], "top_radius": 1})",
        "/base_radius", ">= 0"},
       {R"({"type": "cone", "base": [0,0,0], "base_radius": 1, "top": [0,0,0], "top_radius": 0})",
        "/top", "distance from the base"},
       {R"({"type": "torus", "center": [0,0,0], "axis": [0,1,0], "major": 1, "minor": 1})",
        "/minor", "below the major one, 1, found 1"},
       {R"({"type": "torus", "center": [0,0,0], "axis": [0,1,0], "major": 1, "minor": 0})",
        "/minor", "> 0"},
       {R"({"type": "torus", "center": [0,0,0], "axis": [0,0,0], "major": 1, "minor": 0.5})",
        "/axis", "non-zero length, found [0,0,0]"},
       {R"({"type": "half_space", "normal": [0,0,0], "offset": 1})", "/normal", "non-zero length"},
       {R"({"type": "half_space", "normal": [0,1e-300,0], "offset": 1})", "/normal",
        "non-zero length"},
       {R"({"type": "ellipsoid", "center": [0,0,0], "axes": [[1,0,0],[0,1,0],[1,1,0]]})", "/axes",
        "linearly independent"},
       {R"({"type": "ellipsoid", "center": [0,0,0], "axes": [[1,0,0],[0,1,0]]})", "/axes",
        "three vectors"},
       {R"({"type": "polyhedron", "planes": []})", "/planes", "planes, found an empty array"},
       {R"({"type": "polyhedron", "planes": [[0,1,0]]})", "/planes/0",
        "[nx, ny, nz, d], found [0,1,0]"},
       {R"({"type": "polyhedron", "planes": [[0,0,0,1]]})", "/planes/0",
        "normal has a finite, non-zero"}});
}

TEST_CASE("nodes of unknown type, unknown keys and children are told with what was meant") {
  check_csg(
      {{R"({"type": "shpere", "center": [0,0,0], "radius": 1})", "/type",
        "did you mean \"sphere\"?"},
       {R"({"type": "teapot"})", "/type", "known are \"sphere\", \"box\""},
       {R"({"type": 3})", "/type", "expected a string, found 3"},
       {R"({"center": [0,0,0]})", "", "needs the key \"type\""},
       {"[]", "", "expected an object, found an empty array"},
       {R"({"type": "sphere", "centre": 1, "center": [0,0,0], "radius": 1})", "/centre",
        "unknown key \"centre\" of a sphere; did you mean \"center\"?"},
       {R"({"type": "union", "children": []})", "/children",
        "one child or more, found an empty array"},
       {R"({"type": "union"})", "", "a union needs the key \"children\""},
       {R"({"type": "difference", "children": {}})", "/children", "expected an array"},
       {R"({"type": "intersection", "children": [1]})", "/children/0",
        "expected an object, found 1"},
       {R"({"type": "complement", "child": [)" + kSphere + "]}", "/child", "expected an object"},
       {R"({"type": "complement"})", "", "a complement needs the key \"child\""},
       {R"({"type": "union", "children": [)" + kSphere + R"(], "material": "rde"})", "/material",
        "unknown material \"rde\"; did you mean \"red\"?"},
       {R"({"type": "ref", "shape": "bal"})", "/shape",
        "unknown shape \"bal\"; did you mean \"ball\"?"}});
  check_errors(SceneText::of_csg(R"({"type": "complement", "children": [)" + kSphere + "]}").text(),
               {{"/objects/0/csg", "a complement needs the key \"child\""},
                {"/objects/0/csg/children", "did you mean \"child\"?"}});
}

TEST_CASE("transforms that are no invertible maps are refused") {
  const auto bad = [](const std::string& steps, const std::string& pointer,
                      const std::string& fragment) {
    return Case{transformed(steps), "/transform" + pointer, fragment};
  };
  check_csg(
      {bad("{}", "", "expected an array"),
       bad(R"([{"scale": 0}])", "/0/scale", "not zero, found 0"),
       bad(R"([{"scale": [1,0,1]}])", "/0/scale", "not zero, found [1,0,1]"),
       bad(R"([{"scale": "2"}])", "/0/scale", "a number or a vector"),
       bad(R"([{"translate": [1,2]}])", "/0/translate", "a vector [x, y, z]"),
       bad(R"([{"translate": [0,0,0]}, {"rotate": {"axis": [0,0,0], "angle": 3}}])",
           "/1/rotate/axis", "non-zero"),
       bad(R"([{"rotate": {"axis": [0,1,0]}}])", "/0/rotate", "a rotation needs the key \"angle\""),
       bad(R"([{"rotat": 1}])", "/0/rotat", "did you mean \"rotate\"?"),
       bad(R"([{"translate": [1,0,0], "scale": 2}])", "/0", "expected one key"),
       bad("[{}]", "/0", "found 0"),
       bad(R"([{"matrix": [[1,0,0,0],[0,1,0,0]]}])", "/0/matrix", "3 or 4 rows"),
       bad(R"([{"matrix": [[1,0,0,0],[0,1,0],[0,0,1,0]]}])", "/0/matrix/1",
           "a matrix row of 4 numbers"),
       bad(R"([{"matrix": [[1,2,3,0],[2,4,6,0],[0,0,1,0]]}])", "/0/matrix", "singular"),
       bad(R"([{"matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]}])", "/0/matrix/3",
           "[0, 0, 0, 1]"),
       bad(R"([{"scale": 1e200}, {"scale": 1e200}])", "", "together")});
}

TEST_CASE("duplicate keys are refused wherever they stand") {
  check_errors(
      R"({"graycube": 1, "graycube": 1, )" + SceneText().without("graycube").text().substr(1),
      {{"/graycube", "duplicate key \"graycube\""}});
  check_csg({{R"({"type": "sphere", "center": [0,0,0], "radius": 1, "radius": 2})", "/radius",
              "duplicate key"}});
  check_key("materials",
            {{R"({"red": {}, "red": {}})", "/materials/red", "duplicate key \"red\""}});
  check_key("shapes", {{R"({"a": )" + kSphere + R"(, "a": )" + kSphere + "}", "/shapes/a",
                        "duplicate key \"a\""}});
  // The same key is written in another way.
  check_key("materials", {{R"({"red": {}, "r\u0065d": {}})", "/materials/red", "duplicate key"}});
}

TEST_CASE("a leaf without a material anywhere above it is refused, through refs too") {
  check_key(
      "objects",
      {{R"([{"csg": )" + kSphere + "}]", "/objects/0/csg", "a sphere without a material"},
       {R"([{"csg": {"type": "ref", "shape": "ball"}}])", "/objects/0/csg",
        "the shape \"ball\" has a leaf without a material (/shapes/ball)"},
       {R"([{"csg": {"type": "union", "children": [{"type": "box", "min": [0,0,0], "max": [1,1,1],
                            "material": "red"}, )" +
            kSphere + "]}}]",
        "/objects/0/csg/children/1", "without a material"}});
  // Any place on the way from the object to the leaf will do.
  const std::string shapes =
      R"({"inner": {"type": "union", "children": [)" + kSphere +
      R"(]}, "outer": {"type": "complement", "child": {"type": "ref", "shape": "inner"}},
                              "painted": {"type": "ref", "shape": "inner", "material": "red"}})";
  const auto uses = [&](const std::string& object) {
    return SceneText().with("shapes", shapes).with("objects", "[" + object + "]").text();
  };
  REQUIRE(read_scene_text(uses(R"({"csg": {"type": "ref", "shape": "painted"}})")).scene);
  REQUIRE(read_scene_text(uses(R"({"csg": {"type": "ref", "shape": "outer", "material": "red"}})"))
              .scene);
  REQUIRE(read_scene_text(uses(R"({"material": "red", "csg": {"type": "ref", "shape": "outer"}})"))
              .scene);
  check_errors(uses(R"({"csg": {"type": "ref", "shape": "outer"}})"),
               {{"/objects/0/csg", "(/shapes/inner/children/0)"}});
}

TEST_CASE("cycles of refs are named") {
  const auto ref = [](const std::string& shape) {
    return R"({"type": "ref", "shape": ")" + shape + "\"}";
  };
  check_key("shapes", {{R"({"a": )" + ref("a") + "}", "/shapes/a", "cycle: \"a\" -> \"a\""}});
  check_errors(
      SceneText()
          .with("shapes", R"({"a": )" + ref("b") + R"(, "b": {"type": "union", "children": [)" +
                              ref("c") + ", " + kSphere + R"(]}, "c": )" + ref("a") + "}")
          .with("objects", R"([{"material": "red", "csg": )" + ref("b") + "}]")
          .text(),
      {{"/shapes/c", "cycle: \"a\" -> \"b\" -> \"c\" -> \"a\""}});
}

TEST_CASE("a syntax error carries its line and column") {
  const ReadResult result = read_scene_text("{\n  \"graycube\": 1,\n  \"image\": {\"width\" 5}\n}");
  REQUIRE_FALSE(result.scene);
  REQUIRE(result.errors.size() == 1);
  CHECK(result.errors[0].message == "line 3, column 21: expected ':' after the key, found '5'");
  CHECK(result.errors[0].pointer == "/image");
  CHECK(read_scene_text("").errors.at(0).message.find("the end of the text") != std::string::npos);
  CHECK(read_scene_text(SceneText().text() + "x").errors.at(0).message.find("found 'x'") !=
        std::string::npos);
}

TEST_CASE("errors of a file come all at once, in the order of the text, with their places") {
  const std::string text = R"({"graycube": 1,
"image": {"width": 0, "height": 6},
"camera": {"type": "perspective", "eye": [0,0,0], "look_at": [0,0,0], "up": [0,1,0], "fov": 200},
"lights": [{"type": "point", "position": [0,0,0], "color": [-1,0,-1]}],
"materials": {"red": {"transmit": 2}},
"shapes": {"loop": {"type": "ref", "shape": "loop"}},
"objects": [
  {"material": "rad", "csg": {"type": "sphere", "radius": -1}},
  {"csg": {"type": "bx"}}]})";
  check_errors(text, {{"/image/width", "found 0"},
                      {"/camera/look_at", "from the eye"},
                      {"/camera/fov", "found 200"},
                      {"/lights/0/color/0", "found -1"},
                      {"/lights/0/color/2", "found -1"},
                      {"/materials/red/transmit", "found 2"},
                      {"/shapes/loop", "cycle"},
                      {"/objects/0/material", "did you mean \"red\"?"},
                      {"/objects/0/csg", "needs the key \"center\""},
                      {"/objects/0/csg/radius", "found -1"},
                      {"/objects/1/csg/type", "did you mean \"box\"?"}});
  const auto errors = read_scene_text(text).errors;
  CHECK(errors[2].line == 3);
  CHECK(errors[10].line == 9);
  CHECK(errors[10].column == 20);
}

TEST_CASE("beyond a hundred, errors are only counted") {
  std::string objects = "[";
  for (int i = 0; i < 250; ++i)
    objects += (i > 0 ? "," : "") + std::string(R"({"material": "x", "csg": 1})");
  const auto errors = read_scene_text(SceneText().with("objects", objects + "]").text()).errors;
  REQUIRE(errors.size() == kMaxReportedErrors + 1);
  CHECK(errors[99].pointer == "/objects/49/csg");
  CHECK(errors.back().pointer.empty());
  CHECK(errors.back().message == "and 400 more errors");
}
