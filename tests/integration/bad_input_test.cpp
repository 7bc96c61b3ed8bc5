// Bad scenes and bad usage: status 2, one line each, at once and without a trace.
#include <sys/stat.h>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

constexpr const char* kGood = R"({
  "graycube": 1,
  "image": {"width": 32, "height": 24},
  "camera": {"type": "perspective", "eye": [0,1,-6], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
  "lights": [{"type": "point", "position": [5,9,-6]}],
  "materials": {"brass": {"color": [0.8,0.6,0.2]}},
  "shapes": {"bolt": {"type": "cylinder", "base": [0,0,0], "top": [0,1,0], "radius": 0.2}},
  "objects": [
    {"name": "ball", "material": "brass", "csg": {"type": "sphere", "center": [0,0,0], "radius": 1}},
    {"name": "rod", "material": "brass", "csg": {"type": "ref", "shape": "bolt"}}
  ]
})";

/// The good scene with a piece of it replaced; the place of its one error, and words that the
/// reason must contain.
struct Mistake {
  const char* name;
  std::string from, to;
  const char* where;
  const char* why;
};

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> list{
      {"negative radius", "\"radius\": 1}", "\"radius\": -1}", ":/objects/0/csg/radius",
       "found -1"},
      {"missing radius", ", \"radius\": 1}", "}", ":/objects/0/csg", "radius"},
      {"text for a number", "\"radius\": 1}", "\"radius\": \"1\"}", ":/objects/0/csg/radius",
       "number"},
      {"short vector", "[0,0,0], \"radius\": 1}", "[0,0], \"radius\": 1}", ":/objects/0/csg/center",
       ""},
      {"unknown shape type", "\"sphere\"", "\"spere\"", ":/objects/0/csg/type", "sphere"},
      {"unknown key", "\"radius\": 1}", "\"radius\": 1, \"radios\": 2}", ":/objects/0/csg/radios",
       "radius"},
      {"unknown material", "\"ball\", \"material\": \"brass\"", "\"ball\", \"material\": \"bras\"",
       ":/objects/0/material", "brass"},
      {"no material", "\"ball\", \"material\": \"brass\"", "\"ball\"", ":/objects/0/csg",
       "material"},
      {"reference to nothing", "\"shape\": \"bolt\"", "\"shape\": \"nut\"", ":/objects/1/csg/shape",
       "nut"},
      {"cycle of references",
       "{\"type\": \"cylinder\", \"base\": [0,0,0], \"top\": [0,1,0], \"radius\": 0.2}",
       "{\"type\": \"ref\", \"shape\": \"bolt\"}", ":/shapes/bolt", "cycle"},
      {"operation without children", "{\"type\": \"sphere\", \"center\": [0,0,0], \"radius\": 1}",
       "{\"type\": \"union\", \"children\": []}", ":/objects/0/csg/children", ""},
      {"torus through itself", "{\"type\": \"sphere\", \"center\": [0,0,0], \"radius\": 1}",
       "{\"type\": \"torus\", \"center\": [0,0,0], \"axis\": [0,1,0], \"major\": 1, \"minor\": 2}",
       ":/objects/0/csg/minor", ""},
      {"singular matrix", "\"radius\": 1}", "\"radius\": 1, \"transform\": [{\"scale\": [1,0,1]}]}",
       ":/objects/0/csg/transform/0/scale", "zero"},
      {"colour below zero", "[0.8,0.6,0.2]", "[0.8,-0.6,0.2]", ":/materials/brass/color/1", ""},
      {"too wide a view", "\"fov\": 40", "\"fov\": 180", ":/camera/fov", "180"},
      {"camera without a direction", "\"look_at\": [0,0,0]", "\"look_at\": [0,1,-6]",
       ":/camera/look_at", "distance"},
      {"huge picture", "\"width\": 32", "\"width\": 4000000000", ":/image/width", ""},
      {"no samples", "\"height\": 24", "\"height\": 24, \"samples\": 0", ":/image/samples", ""},
      {"another version", "\"graycube\": 1", "\"graycube\": 2", ":/graycube", "1"},
      {"unknown light", "\"point\"", "\"spot\"", ":/lights/0/type", "point"},
      {"a key of another model", "{\"color\": [0.8,0.6,0.2]}", "{\"roughness\": 0.3}",
       ":/materials/brass/roughness", "did you mean \"shininess\"?"},
      {"missing camera", "\"camera\"", "\"kamera\"", "", "camera"},
      {"key twice", "\"lights\"", "\"image\"", ":/image", ""},
      {"comma missing", "\"width\": 32,", "\"width\": 32", ":/image/width", "line 3"},
      {"infinite number", "\"radius\": 1}", "\"radius\": 1e999}", ":/objects/0/csg/radius", ""},
      {"cut off", "\n  ]\n}", "", ":/objects/1/csg/shape", "line 10"}};
  return list;
}

std::string with(const Mistake& m) {
  std::string text = kGood;
  const auto at = text.find(m.from);
  REQUIRE(at != std::string::npos);
  text.replace(at, m.from.size(), m.to);
  return text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Checks for a refusal with status 2, and only lines that tell what is wrong.
void check_refusal(const Sandbox& sandbox, const Outcome& o, std::size_t files) {
  CHECK(o.status == 2);
  CHECK(o.out.empty());
  CHECK_FALSE(o.err.empty());
  for (const std::string& line : lines_of(o.err)) CHECK(line.starts_with("graycube: "));
  CHECK(sandbox.files().size() == files);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("the scene that the mistakes are made in is a good one") {
  Sandbox sandbox;
  sandbox.write("s.json", kGood);
  const Outcome o = sandbox.run({"check", "s.json"});
  CHECK(o.status == 0);
  CHECK(o.err.empty());
  CHECK(o.out == "s.json: fine: 2 objects, 2 primitives, 1 material, 1 light; picture 32 x 24\n");
  CHECK(sandbox.run({"render", "s.json", "-q"}).status == 0);
}

TEST_CASE("each malformed scene is refused with its place and a reason") {
  REQUIRE(mistakes().size() >= 20);
  for (const Mistake& m : mistakes()) {
    Sandbox sandbox;
    sandbox.write("s.json", with(m));
    for (const Arguments& command :
         {Arguments{"check", "s.json"}, {"render", "s.json", "-n", "2", "-q"}}) {
      const Outcome o = sandbox.run(command);
      INFO(m.name << ": " << o.err);
      check_refusal(sandbox, o, 1);
      const auto lines = lines_of(o.err);
      const std::string prefix = std::string("graycube: scene: s.json") + m.where + ": ";
      CHECK(std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.starts_with(prefix) && has(line, m.why);
      }));
    }
  }
}

TEST_CASE("check finds all errors of a scene at once") {
  Sandbox sandbox;
  std::string text = with(mistakes()[0]);
  text.replace(text.find("[0.8,0.6,0.2]"), 13, "[0.8,0.6]");
  text.replace(text.find("\"fov\": 40"), 9, "\"fov\": 0");
  sandbox.write("s.json", text);
  const Outcome o = sandbox.run({"check", "s.json"});
  check_refusal(sandbox, o, 1);
  CHECK(lines_of(o.err).size() == 3);
}

TEST_CASE("files that are no scenes are refused") {
  Sandbox sandbox;
  sandbox.write("empty.json", "");
  sandbox.write("null.json", "null");
  sandbox.write("bytes.json", std::string("\x00\xff\xfe{\"graycube\": 1}", 17));
  sandbox.write("deep.json", std::string(100000, '['));
  sandbox.write("model.csg", "cube(size = [1, 1, 1], center = false)");
  std::filesystem::create_directory(sandbox / "folder.json");
  for (const char* name : {"empty.json", "null.json", "bytes.json", "deep.json", "model.csg",
                           "folder.json", "none.json", "folder.json/x.json"}) {
    const Outcome o = sandbox.run({"render", name, "-n", "2"});
    INFO(name << ": " << o.err);
    check_refusal(sandbox, o, 6);
    CHECK(lines_of(o.err).size() == 1);
  }
}

TEST_CASE("bad usage is refused in one line") {
  Sandbox sandbox;
  sandbox.write("s.json", kGood);
  for (const Arguments& arguments : std::vector<Arguments>{
           {},
           {"paint", "s.json"},
           {"render"},
           {"render", "s.json", "-n", "3"},
           {"render", "s.json", "-n", "0"},
           {"render", "s.json", "-n", "2048"},
           {"render", "s.json", "-n", "many"},
           {"render", "s.json", "--threads", "0"},
           {"render", "s.json", "--size", "0x5"},
           {"render", "s.json", "--size", "99999x99999"},
           {"render", "s.json", "--samples", "65"},
           {"render", "s.json", "--max-depth", "1001"},
           {"render", "s.json", "--max-depth", "121", "--algorithm", "roth"},
           {"render", "s.json", "--timeout", "0"},
           {"render", "s.json", "--algorithm", "magic"},
           {"render", "s.json", "--grain", "grain"},
           {"render", "s.json", "--shadows", "soft"},
           {"render", "s.json", "--partition", "fair"},
           {"render", "s.json", "--scatter", "9"},
           {"render", "s.json", "--flow", "free"},
           {"render", "s.json", "--queue", "0"},
           {"render", "s.json", "-o", "none/out.exr"},
           {"render", "s.json", "-o", "s.json"},
           {"render", "s.json", "-o", "a.exr", "--stats", "a.exr"},
           {"render", "s.json", "--pgn", "a.png"},
           {"render", "s.json", "t.json"},
           {"submit", "s.json", "-o", "a.exr"},
           {"submit", "s.json", "--algorithm", "serial"},
           {"status"},
           {"status", "one"},
           {"fetch", "1"},
           {"jobs", "--connect", "tcp://198.51.100.1:80"},
           {"jobs", "--connect", "somewhere"},
           {"up", "--listen", "tcp://0.0.0.0:5555"},
           {"up", "--http", "0.0.0.0:8080"},
           {"up", "--outbox-rays", "0"},
           {"compare", "s.json", "--plot", "none/out.svg"},
           {"compare", "s.json", "-n", "3"},
           {"simulate", "s.json", "-n", "4,5"},
           {"simulate", "s.json", "-n", "4", "--link-gbps", "0"},
           {"simulate", "s.json", "-n", "4", "--hosts", "0"},
           {"simulate", "s.json", "-n", "64,4", "--hosts", "8"},
           {"simulate", "s.json", "-n", "4", "--local-us", "1"},
           {"simulate", "s.json", "-n", "4", "--algorithm", "serial"},
           {"simulate", "s.json", "-n", "4", "--plot", "none/out.svg"},
           {"draw", "s.json"},
           {"draw", "s.json", "--figure", "sphere"},
           {"draw", "s.json", "--figure", "bsp", "-o", "a.png"},
           {"draw", "s.json", "--figure", "bsp", "--subdivision", "octree"},
           {"draw", "s.json", "--figure", "token", "-n", "1"},
           {"draw", "s.json", "--figure", "token", "-n", "128"},
           {"draw", "s.json", "--figure", "token", "--algorithm", "roth"},
           {"draw", "s.json", "--figure", "entry", "--subdivision", "linked", "--entry", "descent"},
           {"draw", "s.json", "--figure", "traffic", "-o", "none/out.svg"},
           {"convert", "s.json", "s.stl"},
           {"convert", "s.json", "s.json"},
           {"convert", "s.json"}}) {
    const Outcome o = sandbox.run(arguments);
    std::string name;
    for (const std::string& a : arguments) name += a + " ";
    INFO(name << ": " << o.err);
    check_refusal(sandbox, o, 1);
    CHECK(lines_of(o.err).size() == 1);
  }
}

TEST_CASE("what check finds comes as JSON, too, whether it is fine or not") {
  Sandbox sandbox;
  sandbox.write("s.json", kGood);
  const auto fine = nlohmann::json::parse(sandbox.run({"check", "s.json", "--json"}).out);
  CHECK(fine.at("fine") == true);
  CHECK(fine.at("objects") == 2);
  CHECK(fine.at("width") == 32);
  sandbox.write("b.json", "{\n  \"graycube\": 2}");
  const Outcome bad = sandbox.run({"check", "b.json", "--json"});
  CHECK(bad.status == 2);
  const auto errors = nlohmann::json::parse(bad.out).at("errors");
  REQUIRE_FALSE(errors.empty());
  CHECK(errors[0].at("where").get<std::string>().starts_with("b.json"));
  CHECK(has(bad.err, "/graycube: expected 1, found 2 (line 2, column 15)"));
}

TEST_CASE("a folder that can't be written to is noticed before the render") {
  Sandbox sandbox;
  sandbox.write("s.json", kGood);
  // Even root may not write there.
  const Outcome o = sandbox.run({"render", "s.json", "-o", "/proc/out.exr"});
  INFO(o.err);
  CHECK(o.status == 2);
  CHECK(o.out.empty());
  CHECK(lines_of(o.err).size() == 1);
}

TEST_CASE("commands without a farm say so within seconds") {
  Sandbox sandbox;
  sandbox.write("s.json", kGood);
  for (const Arguments& arguments : std::vector<Arguments>{
           {"submit", "s.json"},
           {"down"},
           {"nodes", "--connect", "ipc://" + (sandbox / "no-socket").string()}}) {
    const Outcome o = sandbox.run(arguments);
    INFO(o.err);
    CHECK(o.status == 1);
    REQUIRE(lines_of(o.err).size() == 1);
    CHECK(o.err.starts_with("graycube: farm: ipc:///"));
    CHECK(has(o.err, "nobody answers; start one with 'graycube up'"));
    CHECK(o.wall_s < 10);
  }
}

}  // namespace
}  // namespace graycube
