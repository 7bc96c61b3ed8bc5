// Models from OpenSCAD, through to pictures.
#include <catch2/catch.hpp>

#include "film/picture_files.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Renders the model on 8 nodes and here; the same picture, and something in it.
void check_model(Sandbox& sandbox, const std::filesystem::path& model) {
  const Outcome checked = sandbox.run({"check", model.string()});
  INFO(model << ": " << checked.err);
  REQUIRE(checked.status == 0);
  for (const auto& [algorithm, out] : {std::pair{"macro", "a.exr"}, {"serial", "b.exr"}}) {
    const Outcome o = sandbox.run({"render", model.string(), "-n", "8", "--algorithm", algorithm,
                                   "--size", "96x72", "-o", out, "-q"});
    INFO(o.err);
    REQUIRE(o.status == 0);
  }
  CHECK((file_bytes(sandbox / "a.exr") == file_bytes(sandbox / "b.exr")));
  const Picture picture = read_exr(sandbox / "a.exr");
  REQUIRE(picture.width == 96);
  // The framed model covers a good part of the picture, the corner shows the background.
  std::size_t other = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    other += picture.rgb[i] != picture.rgb[0] || picture.rgb[i + 1] != picture.rgb[1];
  }
  CHECK(other > 96 * 72 / 20);
}

TEST_CASE("the OpenSCAD models that come along are rendered on 8 nodes") {
  Sandbox sandbox;
  for (const char* name : {"bracket.csg", "dice.csg", "lantern.csg"}) {
    check_model(sandbox, scene_file("openscad") / name);
  }
}

TEST_CASE("OpenSCAD's own examples are rendered on 8 nodes") {
  const auto openscad = find_program("openscad");
  const std::filesystem::path examples = "/usr/share/openscad/examples";
  if (!openscad || !std::filesystem::exists(examples)) {
    WARN("no openscad with its examples here");
    return;
  }
  Sandbox sandbox;
  for (const char* name : {"Basics/CSG.scad", "Old/example001.scad", "Old/example005.scad"}) {
    const Outcome o = sandbox.run_program(
        *openscad, {"-o", (sandbox / "m.csg").string(), (examples / name).string()});
    INFO(name << ": " << o.err);
    REQUIRE(o.status == 0);
    check_model(sandbox, sandbox / "m.csg");
  }
}

TEST_CASE("a converted OpenSCAD model is the scene that is rendered") {
  Sandbox sandbox;
  const std::string model = scene_file("openscad/dice.csg").string();
  REQUIRE(sandbox.run({"convert", model, "dice.json"}).status == 0);
  const std::string size = "64x64";
  REQUIRE(sandbox.run({"render", "dice.json", "--size", size, "-o", "a.exr", "-q"}).status == 0);
  REQUIRE(sandbox.run({"render", model, "--size", size, "-o", "b.exr", "-q"}).status == 0);
  // Square like the default, so framed alike.
  CHECK((read_exr(sandbox / "a.exr") == read_exr(sandbox / "b.exr")));
  REQUIRE(sandbox.run({"convert", model, "dice.pov"}).status == 0);
}

}  // namespace
}  // namespace graycube
