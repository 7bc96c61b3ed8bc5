#include "cli/scene_input.hpp"

#include <signal.h>

#include <cmath>
#include <fstream>

#include "cli/expect_failure.hpp"
#include "cli/openscad_process.hpp"
#include "cli/temporary_folder.hpp"
#include "formats/brlcad/model.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/json/cbor_writer.hpp"

namespace graycube {
namespace {

constexpr const char* kBall = R"({
  "graycube": 1, "image": {"width": 8, "height": 4},
  "camera": {"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
  "lights": [], "materials": {"m": {}},
  "objects": [{"material": "m", "csg": {"type": "sphere", "center": [0,0,0], "radius": 1}}]})";

TEST_CASE("a scene file goes to the farm byte for byte") {
  const TemporaryFolder folder;
  const SceneInput input = read_scene_input(write_file(folder / "ball.json", kBall));
  CHECK(input.name == "ball.json");
  CHECK(input.text == kBall);
  CHECK(input.scene.objects.size() == 1);
}

TEST_CASE("a scene without lights is read with a warning") {
  const TemporaryFolder folder;
  const SceneInput dark = read_scene_input(write_file(folder / "ball.json", kBall));
  REQUIRE(dark.warnings.size() == 1);
  CHECK(line_of(dark.warnings.front()).find("ball.json:/lights: there are no lights") !=
        std::string::npos);
  std::string lit = kBall;
  lit.replace(lit.find("[],"), 3, R"([{"type": "point", "position": [0,9,0]}],)");
  CHECK(read_scene_input(write_file(folder / "lit.json", lit)).warnings.empty());
}

TEST_CASE("an OpenSCAD tree becomes a scene of the size asked for, as text only for a farm") {
  const TemporaryFolder folder;
  const auto path = write_file(folder / "ball.csg", "sphere($fn = 0, $fa = 12, $fs = 2, r = 3);\n");
  control::JobOptions options;
  options.width = 30;
  options.height = 20;
  SceneInput input = read_scene_input(path, options);
  CHECK(input.name == "ball.csg");
  CHECK(input.scene.settings.image == ImageSize{30, 20, 1});
  CHECK(input.text.empty());
  prepare_for_farm(input, options);
  const ReadResult again = read_scene_text(input.text);
  REQUIRE(again.scene);
  CHECK(*again.scene == input.scene);
}

constexpr const char* kTetrahedron =
    "OFF 4 4 0\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST_CASE("a mesh file becomes a framed scene of one mesh") {
  const TemporaryFolder folder;
  control::JobOptions options;
  options.width = 30;
  options.height = 20;
  SceneInput input = read_scene_input(write_file(folder / "part.off", kTetrahedron), options);
  CHECK(input.scene.settings.image == ImageSize{30, 20, 1});
  REQUIRE(input.scene.objects.size() == 1);
  CHECK(std::get<MeshShape>(input.scene.objects[0].csg.value).mesh.triangles.size() == 4);
  CHECK(input.text.empty());
  prepare_for_farm(input, options);
  const ReadResult again = read_scene_text(input.text);
  REQUIRE(again.scene);
  CHECK(*again.scene == input.scene);
}

TEST_CASE("what goes to the farm of a scene with a mesh file holds the mesh") {
  const TemporaryFolder folder;
  write_file(folder / "part.off", kTetrahedron);
  std::string text = kBall;
  const std::string ball = R"({"type": "sphere", "center": [0,0,0], "radius": 1})";
  text.replace(text.find(ball), ball.size(), R"({"type": "mesh", "file": "part.off"})");
  SceneInput input = read_scene_input(write_file(folder / "scene.json", text));
  prepare_for_farm(input, {});
  CHECK(input.text.find("part.off") == std::string::npos);
  const ReadResult again = read_scene_text(input.text);
  REQUIRE(again.scene);
  CHECK(*again.scene == input.scene);
}

TEST_CASE("a mesh file's faults have the file and the line once") {
  const TemporaryFolder folder;
  const auto path = write_file(folder / "open.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK(refusal([&] { read_scene_input(path); })
            .starts_with("graycube: scene: " + path.string() +
                         ": not closed: the edge from (0, 0, 0) to (1, 0, 0)"));
}

TEST_CASE("every error of a scene has the file and the place") {
  const TemporaryFolder folder;
  std::string text = kBall;
  text.replace(text.find("\"radius\": 1"), 11, "\"radius\": -1");
  text.replace(text.find("\"width\": 8"), 10, "\"width\": 0");
  const auto path = write_file(folder / "ball.json", text);
  try {
    read_scene_input(path);
    FAIL("the scene was taken");
  } catch (const Failure& failure) {
    CHECK(failure.status() == ExitStatus::kBadInput);
    REQUIRE(failure.problems().size() == 2);
    CHECK(failure.problems()[0].where == path.string() + ":/image/width");
    CHECK(failure.problems()[1].where == path.string() + ":/objects/0/csg/radius");
  }
}

TEST_CASE("an OpenSCAD tree's errors have the file and the line") {
  const TemporaryFolder folder;
  const auto path = write_file(folder / "bad.csg", "group() {\n  spere(r = 3);\n}\n");
  CHECK(refusal([&] {
          read_scene_input(path);
        }).starts_with("graycube: scene: " + path.string() + ":2: "));
}

TEST_CASE("a part that is left out is a warning, and an error when the import is strict") {
  const TemporaryFolder folder;
  const auto path =
      write_file(folder / "a.asc", testing::kV4Head + testing::v4_sphere("s", 0, 0, 0, 1) +
                                       testing::v4_region("r") + testing::v4_member('u', "s") +
                                       testing::v4_member('-', "gone"));
  const std::string where = path.string() + ":gone";
  const SceneInput input = read_scene_input(path);
  REQUIRE(input.warnings.size() == 1);
  CHECK(input.warnings[0] == Problem{"warning", where, "is not in the database, and left out"});
  ModelChoice choice;
  choice.is_strict = true;
  CHECK(refusal([&] { read_scene_input(path, {}, choice); }) ==
        "graycube: scene: " + where + ": is not in the database, and left out");
}

TEST_CASE("a byte order mark and any line ends make no difference") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.json", kBall},
      {"a.csg", "group() {\n sphere($fn = 0, $fa = 12, $fs = 2, r = 3);\n}\n"},
      {"a.asc", testing::kV4Head + testing::v4_sphere("s", 0, 0, 0, 1) + testing::v4_region("r") +
                    testing::v4_member('u', "s")},
      {"a.off", kTetrahedron}};
  for (const auto& [name, text] : files) {
    const Scene plain = read_scene_input(write_file(folder / name, text)).scene;
    CHECK(plain.objects.size() == 1);
    for (const char* line_end : {"\n", "\r\n", "\r"}) {
      for (const char* mark : {"", "\xEF\xBB\xBF"}) {
        std::string other;
        for (const char c : text) c == '\n' ? other += line_end : other += c;
        INFO(name << " with line ends of " << std::string(line_end).size() << " bytes");
        CHECK(read_scene_input(write_file(folder / name, mark + other)).scene == plain);
      }
    }
  }
}

TEST_CASE("what is no scene file is told apart") {
  const TemporaryFolder folder;
  CHECK(refusal([&] {
          read_scene_input(folder / "none.json");
        }).ends_with("No such file or directory"));
  CHECK(refusal([&] {
          read_scene_input(folder.path());
        }).ends_with("expected a name ending in " + scene_endings_text()));
  ModelChoice facets;
  facets.facets = true;
  CHECK(refusal([&] {
          read_scene_input(write_file(folder / "a.json", ""), {}, facets);
        }).find("--facets") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.json");
  CHECK(refusal([&] { read_scene_input(folder / "folder.json"); }).ends_with("is a folder"));
}

TEST_CASE("a scene in CBOR is the scene, and goes to the farm byte for byte") {
  const TemporaryFolder folder;
  const std::string cbor = cbor_of(JsonTree(std::string_view(kBall)));
  const SceneInput input = read_scene_input(write_file(folder / "ball.cbor", cbor));
  CHECK(input.text == cbor);
  CHECK(input.scene == read_scene_input(write_file(folder / "ball.json", kBall)).scene);
}

/// An executable script in the folder.
std::filesystem::path script(const TemporaryFolder& folder, const std::string& text) {
  const auto path = write_file(folder / "openscad", "#!/bin/sh\n" + text);
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST_CASE("OpenSCAD's file, its emptiness and its errors come back from a child process") {
  const TemporaryFolder folder;
  const auto evaluate = [&](const std::string& text, int seconds = 60) {
    OpenscadProcess process(script(folder, text), seconds);
    return process.evaluate("cube(1);", OpenscadProgram::Format::kOff);
  };
  CHECK(evaluate("cat \"$3\" > \"$2\"; echo ERROR: none >&2").text == "cube(1);");
  CHECK(evaluate("echo 'ERROR: no such thing' >&2; exit 1").trouble ==
        "openscad: ERROR: no such thing");
  CHECK(evaluate("exit 3").trouble == "openscad ended with status 3");
  CHECK(evaluate("kill -9 $$").trouble == "openscad ended by signal 9");
  const auto empty = evaluate("echo 'Current top level object is empty.' >&2; exit 1");
  CHECK((empty.trouble.empty() && empty.text.empty()));
}

TEST_CASE("OpenSCAD is killed when its time is up, and its files go") {
  const TemporaryFolder folder;
  const auto process =
      script(folder, "echo $$ > " + (folder / "pid").string() + "; echo \"$2\" > " +
                         (folder / "output").string() + "; exec sleep 60");
  {
    OpenscadProcess openscad(process, 1);
    CHECK(openscad.evaluate("cube(1);", OpenscadProgram::Format::kOff).trouble ==
          "openscad took more than 1 s");
  }
  std::ifstream pid_file(folder / "pid"), output_file(folder / "output");
  int pid = 0;
  std::string output;
  REQUIRE((pid_file >> pid));
  REQUIRE(std::getline(output_file, output));
  CHECK(::kill(pid, 0) != 0);
  CHECK_FALSE(std::filesystem::exists(std::filesystem::path(output).parent_path()));
}

TEST_CASE("every ending that is told of is read, and no other") {
  for (const std::string_view ending : kSceneEndings) {
    CHECK_THAT(refusal([&] { read_scene_input("/nowhere/part" + std::string(ending)); }),
               !Catch::Contains("expected a name ending in"));
  }
  CHECK(refusal([&] { read_scene_input("part.step"); }) ==
        "graycube: scene: part.step: expected a name ending in .json, .cbor, .scad, .csg, .g, "
        ".asc, .stl, .off, .obj, .ply, .3mf, .gltf, .glb, .dae, .3ds, .amf, .x3d or .fbx");
}

TEST_CASE("solids that can't be computed are told by pointers in scenes, by names in models") {
  SceneInput input;
  input.path = "far.json";
  input.scene.materials.resize(1);
  input.scene.objects.push_back({"part 1: sphere, line 3", 0, {}});
  input.scene.objects.front().csg.value = SphereShape{{1e30, 0, 0}, 1};
  CHECK(
      refusal([&] { compile_input(input); }) ==
      "graycube: scene: far.json:/objects/0/csg: the sphere of \"part 1: sphere, line 3\" reaches "
      "beyond 1e18");
  input.path = "far.csg";
  CHECK(refusal([&] { compile_input(input); }) ==
        "graycube: scene: far.csg: the sphere of \"part 1: sphere, line 3\" reaches beyond 1e18");
  input.scene.objects.front().csg.value = SphereShape{{HUGE_VAL, 0, 0}, 1};
  CHECK(refusal([&] { prepare_for_farm(input, {}); }) ==
        "graycube: scene: far.csg: the model's numbers leave the range of doubles");
}

TEST_CASE("what only serial can render is refused before a farm is asked") {
  SceneInput input;
  input.name = "deep.json";
  input.scene.settings.max_depth = kMaxCreditDepth;
  input.scene.settings.lights.resize(kMaxCreditLights);
  CHECK_NOTHROW(prepare_for_farm(input, {}));
  control::JobOptions deeper;
  deeper.max_depth = kMaxCreditDepth + 1;
  CHECK(refusal([&] {
          prepare_for_farm(input, deeper);
        }).starts_with("graycube: scene: deep.json:/max_depth: only --algorithm serial"));
  input.scene.settings.lights.emplace_back();
  CHECK(refusal([&] {
          prepare_for_farm(input, {});
        }).starts_with("graycube: scene: deep.json:/lights: only --algorithm serial"));
}

}  // namespace
}  // namespace graycube
