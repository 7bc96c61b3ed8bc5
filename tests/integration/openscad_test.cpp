// Models from OpenSCAD, from the import to the picture.
#include <sys/stat.h>

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// Checks that the model has the same picture on 8 nodes and here, and that it shows something.
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

/// Everything that the importer does by itself: exact sweeps, meshes, hulls, flat operations.
constexpr const char* kEveryConstruct = R"(
linear_extrude(height = 3, center = true) {
  difference() {
    square(size = [8, 6], center = true);
    multmatrix([[1, 0, 0, 1], [0, 1.5, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) circle($fn = 0, $fa = 12, $fs = 2, r = 1);
    polygon(points = [[-3, -2], [-1, -2], [-2, 2], [-2, -1]], paths = undef);
  }
}
multmatrix([[1, 0, 0, 14], [0, 0.8, -0.6, 0], [0, 0.6, 0.8, 0], [0, 0, 0, 1]]) {
  difference() {
    rotate_extrude(angle = 300, $fn = 0) {
      polygon(points = [[2, 0], [6, 0], [5, 2], [6, 4], [3, 3]], paths = [[0, 1, 2, 3, 4]]);
      multmatrix([[1, 0, 0, 4], [0, 1, 0, 4], [0, 0, 1, 0], [0, 0, 0, 1]]) circle(r = 1.5, $fn = 0);
    }
    linear_extrude(height = 9, twist = 90, slices = 5, scale = [0.5, 0.7]) {
      offset(r = 0.5, $fn = 12) square(size = 5);
    }
  }
}
multmatrix([[1, 0, 0, 0], [0, 1, 0, 14], [0, 0, 1, 0], [0, 0, 0, 1]]) color([0.2, 0.5, 1, 0.5]) {
  hull() { cube(size = [4, 4, 1], center = true); multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]) sphere(r = 1); }
  hull() { cylinder(h = 1, r1 = 2, r2 = 1); multmatrix([[1, 0, 0, -5], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, 0, 1]]) cylinder(h = 2, r1 = 1, r2 = 1); }
  minkowski() { linear_extrude(height = 1) polygon(points = [[-9, 0], [-6, 0], [-8, 1], [-9, 4]]); sphere(r = 0.5); }
}
multmatrix([[1, 0, 0, 12], [0, 1, 0, 14], [0, 0, 1, 0], [0, 0, 0, 1]]) {
  polyhedron(points = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0], [2, 2, 1], [2, 2, 4]],
    faces = [[0, 1, 5], [1, 2, 5], [2, 3, 5], [3, 0, 5], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]);
}
)";

TEST_CASE("a model of every construct is the same here and on nodes, exact and with facets") {
  Sandbox sandbox;
  sandbox.write("every.csg", kEveryConstruct);
  for (const Arguments& facets : {Arguments{}, Arguments{"--facets"}}) {
    std::string reference;
    for (const auto& [algorithm, nodes] : {std::pair{"serial", "1"},
                                           {"roth", "4"},
                                           {"macro", "1"},
                                           {"macro", "4"},
                                           {"macro", "16"}}) {
      Arguments arguments{"render", "every.csg", "--algorithm", algorithm,
                          "-n",     nodes,       "--size",      "90x70",
                          "-o",     "a.exr",     "--aov",       "depth,normal,albedo,object",
                          "-q"};
      arguments.insert(arguments.end(), facets.begin(), facets.end());
      const Outcome o = sandbox.run(arguments);
      INFO(algorithm << " on " << nodes << ": " << o.err);
      REQUIRE(o.status == 0);
      const std::string bytes = file_bytes(sandbox / "a.exr");
      REQUIRE_FALSE(bytes.empty());
      if (reference.empty()) reference = bytes;
      CHECK((bytes == reference));
    }
  }
}

TEST_CASE("a scene in CBOR gives the picture of its JSON, and comes back as it was") {
  Sandbox sandbox;
  sandbox.write("every.csg", kEveryConstruct);
  REQUIRE(sandbox.run({"convert", "every.csg", "a.json"}).status == 0);
  REQUIRE(sandbox.run({"convert", "a.json", "a.cbor"}).status == 0);
  REQUIRE(sandbox.run({"convert", "a.cbor", "b.json"}).status == 0);
  CHECK(file_bytes(sandbox / "a.json") == file_bytes(sandbox / "b.json"));
  for (const char* scene : {"a.json", "a.cbor"}) {
    const Outcome o = sandbox.run(
        {"render", scene, "-n", "2", "--size", "64x64", "-o", std::string(scene) + ".exr", "-q"});
    INFO(o.err);
    REQUIRE(o.status == 0);
  }
  CHECK((read_exr(sandbox / "a.json.exr") == read_exr(sandbox / "a.cbor.exr")));
}

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

TEST_CASE("OpenSCAD's own errors are passed on, with the line of what it was asked for") {
  Sandbox sandbox;
  FakeOpenscad fake(sandbox, "echo 'ERROR: it is broken' >&2\nexit 1\n");
  sandbox.write("m.csg", "cube(1);\ntext(text = \"a\");\nminkowski() { surface(); }\n");
  const Outcome o = fake.run({"check", "m.csg"});
  CHECK(o.status == 0);
  CHECK(o.err.find("m.csg:3: minkowski() is left out: openscad: ERROR: it is broken\n") !=
        std::string::npos);
  CHECK(fake.run({"check", "--strict", "m.csg"}).status == 2);
  sandbox.write("m.scad", "cube(;");
  const Outcome scad = fake.run({"check", "m.scad"});
  CHECK(scad.status == 2);
  CHECK(scad.err == "graycube: openscad: m.scad: ERROR: it is broken\n");
  CHECK(sandbox.temporary_files().empty());
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

/// A model of all kinds of numbers that six digits can't hold; with modules of the user's, and of a
/// file that it uses.
constexpr const char* kEndless = R"(
use <lib.scad>
module twice() { children(); translate([0, 0, 7 / 3]) children(); }
module every() { for (i = [0:$children - 1]) translate([i * 10 / 7, 0, 0]) { children(i); if ($children > 1) cube(1 / 9); } }
every() { cube([1 / 3, 2 / 7, 5]); sphere(d = 2 / 3); }
translate([1 / 3, 1 / 7]) rotate([100 / 3, 0, 360 / 7]) mirror([1, 2, 0]) scale([1 / 3, 1, 2]) twice() cylinder(7 / 3, d1 = 1 / 3, r2 = 1 / 7);
rotate(100 / 7, [1 / 3, 2, 1]) multmatrix([[1 / 3, 0, 0, 1 / 7], [0, 2, 0, 0]]) square([1 / 3, 1 / 7], center = true);
linear_extrude(10 / 3, twist = 100 / 3, scale = 1 / 3) offset(1 / 7) polygon([[1 / 3, 0], [7, 0], [0, 1 / 7]]);
rotate_extrude(angle = 1000 / 3) translate([5 / 3, 0]) circle(1 / 3);
polyhedron([[0, 0, 1 / 3], [1 / 7, 0, 0], [0, 1, 0], [0, 0, -1]], [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]);
difference() { peg(10 / 3); *cube(1 / 3); #cube(1 / 7, center = true); }
)";
constexpr const char* kPeg =
    "module peg(h) { translate([-h / 7, 0, 0]) cylinder(h, 2 / 3, 2 / 3, center = true, $fn = 7); "
    "}";

TEST_CASE("numbers of a .scad file come with all their digits, whatever holds them") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  sandbox.write("lib.scad", kPeg);
  for (const std::string& model : {std::string("cube([1 / 3, 2, 3]);"), std::string(kEndless)}) {
    sandbox.write("m.scad", model);
    const Outcome o = sandbox.run({"convert", "m.scad", "m.json"});
    INFO(model << "\n" << o.err);
    REQUIRE(o.status == 0);
    const std::string json = file_bytes(sandbox / "m.json");
    CHECK(json.find("\"digits\"") == std::string::npos);
    CHECK(json.find("0.3333333333333333") != std::string::npos);
    CHECK(json.find("0.333333,") == std::string::npos);
  }
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE(
    "a model that isn't the same when it is evaluated again keeps its six digits, and its messages "
    "come once") {
  if (!find_program("openscad")) {
    WARN("no openscad here");
    return;
  }
  Sandbox sandbox;
  // The models have modules of the user's in the place of OpenSCAD's, random numbers, and arguments
  // that OpenSCAD doesn't take.
  for (const char* model :
       {"module cube(s) { sphere(s / 3); } cube(1);", "translate(rands(0, 1, 3)) cube(1 / 3);",
        "echo(\"once\"); cube([1 / 3]); sphere(1 / 3);"}) {
    sandbox.write("m.scad", model);
    const Outcome o = sandbox.run({"convert", "m.scad", "m.json"});
    INFO(model << "\n" << o.err);
    REQUIRE(o.status == 0);
    CHECK(file_bytes(sandbox / "m.json").find("\"digits\": 6") != std::string::npos);
    const std::size_t said = o.err.find("once");
    CHECK((said == std::string::npos || o.err.find("once", said + 1) == std::string::npos));
  }
}

TEST_CASE("a converted OpenSCAD model is the scene that is rendered") {
  Sandbox sandbox;
  const std::string model = scene_file("openscad/dice.csg").string();
  REQUIRE(sandbox.run({"convert", model, "dice.json"}).status == 0);
  const std::string size = "64x64";
  REQUIRE(sandbox.run({"render", "dice.json", "--size", size, "-o", "a.exr", "-q"}).status == 0);
  REQUIRE(sandbox.run({"render", model, "--size", size, "-o", "b.exr", "-q"}).status == 0);
  // The picture is square like the default, and so framed alike.
  CHECK((read_exr(sandbox / "a.exr") == read_exr(sandbox / "b.exr")));
  REQUIRE(sandbox.run({"convert", model, "dice.pov"}).status == 0);
}

}  // namespace
}  // namespace graycube
