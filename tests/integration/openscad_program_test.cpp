// How the program openscad is run for models, and what of its work and words reaches the user.
#include <sys/stat.h>

#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Runs the command with a script for `openscad`.
class FakeOpenscad {
 public:
  FakeOpenscad(Sandbox& sandbox, const std::string& text) : sandbox_(sandbox) {
    std::filesystem::create_directory(sandbox / "fake");
    const auto path = sandbox.write("fake/openscad", "#!/bin/sh\n" + text);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  /// `before` stands in front of the command.
  Outcome run(const Arguments& arguments, const Arguments& before = {}) {
    Arguments all{"PATH=" + (sandbox_ / "fake").string() + ":/usr/bin:/bin"};
    all.insert(all.end(), before.begin(), before.end());
    all.push_back(GRAYCUBE_COMMAND);
    all.insert(all.end(), arguments.begin(), arguments.end());
    return sandbox_.run_program("/usr/bin/env", all);
  }

 private:
  Sandbox& sandbox_;
};

constexpr const char* kTetrahedron =
    "printf 'OFF 4 4 0\\n0 0 0\\n2 0 0\\n0 2 0\\n0 0 2\\n3 0 2 1\\n3 0 1 3\\n3 1 2 3\\n3 0 3 2\\n' "
    "> \"$2\"\n";

TEST_CASE("what OpenSCAD evaluates is asked for once, said once, and leaves nothing behind") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "echo run >> runs\n" + std::string(kTetrahedron));
  sandbox.write("m.csg",
                "minkowski() { surface(); sphere(1); }\nminkowski() { surface(); sphere(1); }\n");
  const Outcome o =
      fake.run({"render", "m.csg", "--algorithm", "serial", "--size", "32x32", "-o", "m.exr"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(lines_of(o.err) ==
        std::vector<std::string>{
            "graycube: warning: m.csg:1: minkowski() is evaluated by OpenSCAD, as a mesh"});
  CHECK(lines_of(file_bytes(sandbox / "runs")).size() == 1);
  CHECK(sandbox.temporary_files().empty());
}

/// Writes a tetrahedron for each frame of an animation, as openscad does, and ends at those whose
/// numbers are given, in each run. Without an animation it writes one.
std::string animating(const std::string& broken_frames) {
  return "echo run >> runs\nif [ \"$4\" != --animate ]; then " + std::string(kTetrahedron) +
         "exit 0; fi\ni=0\nwhile [ $i -lt $5 ]; do\necho 'Exporting part.csg...' >&2\n"
         "case $i in " +
         broken_frames +
         ") echo 'ERROR: broken' >&2; exit 1;; esac\n"
         "printf 'OFF 4 4 0\\n0 0 0\\n2 0 0\\n0 2 0\\n0 0 2\\n3 0 2 1\\n3 0 1 3\\n3 1 2 3\\n3 "
         "0 3 2\\n' > \"${2%.off}$(printf %05d $i).off\"\ni=$((i+1))\ndone\n";
}

std::string three_sums() {
  std::string text;
  for (int i = 1; i <= 3; ++i)
    text += "minkowski() { surface(center = true); sphere(" + std::to_string(i) + "); }\n";
  return text;
}

TEST_CASE("all parts that OpenSCAD evaluates go into one run") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, animating("none"));
  sandbox.write("m.csg", three_sums());
  const Outcome o = fake.run({"convert", "m.csg", "m.json"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(lines_of(file_bytes(sandbox / "runs")).size() == 1);
  CHECK(sandbox.json("m.json").at("objects").size() == 3);
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("a part at which OpenSCAD ends is left out, and those behind it are made") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, animating("1"));
  sandbox.write("m.csg", three_sums());
  const Outcome o = fake.run({"convert", "m.csg", "m.json"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(o.err.find("m.csg:2: minkowski() is left out: openscad: ERROR: broken\n") !=
        std::string::npos);
  CHECK(sandbox.json("m.json").at("objects").size() == 2);
  CHECK(lines_of(file_bytes(sandbox / "runs")).size() == 2);
  const Outcome strict = fake.run({"convert", "--strict", "m.csg", "n.json"});
  CHECK(strict.status == 2);
  CHECK(strict.err ==
        "graycube: scene: m.csg:2: minkowski() is left out: openscad: ERROR: broken\n");
}

TEST_CASE("OpenSCAD's own errors are passed on, with the line of what it was asked for") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "echo 'ERROR: it is broken' >&2\nexit 1\n");
  sandbox.write("m.csg", "cube(1);\ntext(text = \"a\");\nminkowski() { surface(); }\n");
  const Outcome o = fake.run({"check", "m.csg"});
  CHECK(o.status == 0);
  CHECK(
      o.err.find(
          "graycube: warning: m.csg:3: minkowski() is left out: openscad: ERROR: it is broken\n") !=
      std::string::npos);
  sandbox.write("all.csg", "minkowski() { surface(); }\n");
  const Outcome all = fake.run({"check", "all.csg"});
  CHECK(all.status == 2);
  CHECK(all.err ==
        "graycube: scene: all.csg:1: minkowski() is left out: openscad: ERROR: it is broken\n"
        "graycube: scene: all.csg: nothing is left of the model\n");
  sandbox.write("m.scad", "cube(;");
  const Outcome scad = fake.run({"check", "m.scad"});
  CHECK(scad.status == 2);
  CHECK(scad.err == "graycube: openscad: m.scad: ERROR: it is broken\n");
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("an error while a model is evaluated refuses it, though OpenSCAD goes on") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "echo 'ERROR: Assertion failed' >&2\necho 'cube(1);' > \"$2\"\n");
  sandbox.write("M.SCAD", "assert(false);");
  const Outcome o = fake.run({"check", "M.SCAD"});
  CHECK(o.status == 2);
  CHECK(o.err == "graycube: openscad: M.SCAD: ERROR: Assertion failed\n");
}

TEST_CASE("an interrupt ends OpenSCAD as well, and leaves nothing behind") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "exec sleep 100\n");
  sandbox.write("m.csg", "minkowski() { surface(); }\n");
  const Outcome o = fake.run({"render", "m.csg", "-o", "m.exr"}, {"timeout", "--signal=INT", "2"});
  CHECK(o.status == 124);
  CHECK(o.err.find("SIGINT: interrupted") != std::string::npos);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
  CHECK_FALSE(std::filesystem::exists(sandbox / "m.exr"));
}

// The thread sanitizer keeps signals back while a file is being opened.
#ifndef __SANITIZE_THREAD__
TEST_CASE("while OpenSCAD isn't at work an interrupt ends an importer at once") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "exit 0\n");
  // No process writes to it, so reading it never ends.
  REQUIRE(::mkfifo((sandbox / "pipe.csg").c_str(), 0600) == 0);
  const Outcome o =
      fake.run({"check", "pipe.csg"}, {"timeout", "--signal=INT", "--kill-after=20", "1"});
  CHECK(o.status == 124);
  CHECK(o.err == "graycube: check: SIGINT: interrupted\n");
}
#endif

TEST_CASE(
    "text, Minkowski sums and files of the model's folder come through OpenSCAD where it is "
    "installed") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  std::filesystem::create_directory(sandbox / "folder");
  sandbox.write("folder/part.off",
                "OFF 4 4 0\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  sandbox.write("folder/m.scad",
                "linear_extrude(2) text(\"Oi\");\ntranslate([0, 20, 0]) minkowski() { difference() "
                "{ cube(4); cube(2); } cylinder(1); }\n"
                "translate([20, 0, 0]) import(\"part.off\");\n");
  const Outcome o = sandbox.run(
      {"render", "folder/m.scad", "--algorithm", "serial", "--size", "40x40", "-o", "m.exr"});
  INFO(o.err);
  CHECK(o.status == 0);
  CHECK(o.err.find("text() is evaluated by OpenSCAD, as a polygon") != std::string::npos);
  CHECK(o.err.find("minkowski() is evaluated by OpenSCAD, as a mesh") != std::string::npos);
  CHECK(sandbox.temporary_files().empty());
}

/// The bounds of the only object, a box.
std::string box_in(Sandbox& sandbox, const std::string& name) {
  const auto scene = sandbox.json(name);
  REQUIRE(scene.at("objects").size() == 1);
  return scene.at("objects")[0].at("csg").at("max").dump();
}

TEST_CASE("models are evaluated as final ones, where OpenSCAD is installed") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  sandbox.write("m.scad", "size = $preview ? 1 : 2; cube(size);");
  REQUIRE(sandbox.run({"convert", "m.scad", "m.json"}).status == 0);
  CHECK(box_in(sandbox, "m.json").find('2') != std::string::npos);
}

TEST_CASE("a model's own view reaches the picture, where OpenSCAD is installed") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  sandbox.write("m.scad", "$vpr = [0, 0, 0]; $vpt = [1, 2, 3]; $vpd = 50; cube(1);");
  const Outcome o = sandbox.run({"convert", "m.scad", "m.json"});
  REQUIRE(o.status == 0);
  CHECK(o.err.empty());
  const auto camera = sandbox.json("m.json").at("camera");
  CHECK(camera.at("eye") == nlohmann::json::array({1, 2, 53}));
  CHECK(camera.at("look_at") == nlohmann::json::array({1, 2, 3}));
}

TEST_CASE("failed assertions, unknown modules and missing files are told in OpenSCAD's words") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  sandbox.write("assert.scad", "w = -1; assert(w > 0, \"w is wrong\"); cube(w);");
  const Outcome failed = sandbox.run({"check", "assert.scad"});
  CHECK(failed.status == 2);
  CHECK(failed.err.find("ERROR: Assertion '(w > 0)' failed: \"w is wrong\"") != std::string::npos);
  CHECK(failed.out.empty());
  sandbox.write("sum.csg", "minkowski() { nonesuch(); cube(1); }\ncube(1);\n");
  const Outcome unknown = sandbox.run({"check", "sum.csg"});
  CHECK(unknown.err.find("Ignoring unknown module 'nonesuch'") != std::string::npos);
  sandbox.write("file.scad", "cube(1); linear_extrude(1) import(\"none.dxf\");");
  const Outcome missing = sandbox.run({"check", "file.scad"});
  CHECK(missing.status == 0);
  CHECK(missing.err.find("import() of none.dxf is left out: there is no such file") !=
        std::string::npos);
}

TEST_CASE(
    "many texts take two runs of OpenSCAD beside those for the model, where it is installed") {
  const auto openscad = find_program("openscad");
  if (!openscad) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "echo run >> runs\nexec " + *openscad + " \"$@\"\n");
  sandbox.write("m.scad",
                "for (i = [1:12]) translate([0, 20 * i, 0]) linear_extrude(1) text(str(i));\n"
                "for (i = [1:4]) translate([30, 20 * i, 0]) minkowski() { difference() { cube(i); "
                "cube(i / 2); } cylinder(1); }\n");
  const Outcome o = fake.run({"convert", "m.scad", "m.json"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  CHECK(sandbox.json("m.json").at("objects").size() == 16);
  // One evaluates the model, one its digits, one makes the solids, one the figures.
  CHECK(lines_of(file_bytes(sandbox / "runs")).size() == 4);
}

}  // namespace
}  // namespace graycube
