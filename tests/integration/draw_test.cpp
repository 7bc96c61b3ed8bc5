// graycube draw: each figure of each scene is a drawing that can be read, and always the same.
#include "catch.hpp"
#include "figures/well_formed.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

constexpr const char* kFigures[] = {"hypercube", "macro-regions", "bsp",  "pointers",
                                    "entry",     "traffic",       "token"};

std::string drawn(Sandbox& sandbox, const std::string& scene, const std::string& figure,
                  Arguments more = {}) {
  Arguments arguments{"draw",     scene_file(scene).string(),
                      "--figure", figure,
                      "-n",       "8",
                      "--size",   "64x48",
                      "-q",       "-o",
                      "f.svg"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome o = sandbox.run(arguments);
  INFO(scene << " " << figure << ": " << o.err);
  REQUIRE(o.status == 0);
  CHECK(o.out.empty());
  CHECK(o.err.empty());
  const std::string svg = file_bytes(sandbox / "f.svg");
  CHECK(svg.starts_with("<svg "));
  CHECK(testing::xml_problem(svg).empty());
  return svg;
}

TEST_CASE("every figure is drawn, of perspective and orthographic scenes") {
  Sandbox sandbox;
  for (const char* scene : {"mirrors.json", "glass.json", "ortho.json"}) {
    for (const char* figure : kFigures) {
      const std::string svg = drawn(sandbox, scene, figure, {"--shadows", "forward"});
      CHECK(svg.size() < 100'000);
    }
    for (const char* figure : {"bsp", "pointers", "entry"}) {
      drawn(sandbox, scene, figure, {"--subdivision", "linked", "--shadows", "forward"});
    }
  }
}

TEST_CASE("a figure is the same to the byte each time") {
  Sandbox sandbox;
  for (const char* figure : kFigures) {
    const Arguments as_in_1987{"--shadows", "forward", "--partition", "regular"};
    CHECK(drawn(sandbox, "first.json", figure, as_in_1987) ==
          drawn(sandbox, "first.json", figure, as_in_1987));
  }
}

TEST_CASE("a figure goes by its scene's name, and says where it is") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"draw", scene_file("first.json").string(), "--figure", "bsp"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(o.out == "first-bsp.svg\n");
  CHECK(sandbox.files() == std::vector<std::string>{"first-bsp.svg"});
}

TEST_CASE("a run without rays between nodes has no traffic to draw, and that is said") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"draw", scene_file("ortho.json").string(), "--figure", "traffic",
                                 "--shadows", "local", "--max-depth", "0", "--size", "32x32"});
  INFO(o.err);
  CHECK(o.status == 2);
  CHECK(o.err.find("no ray goes from one node to another") != std::string::npos);
  CHECK(sandbox.files().empty());
}

}  // namespace
}  // namespace graycube
