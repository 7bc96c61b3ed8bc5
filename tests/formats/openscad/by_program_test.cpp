// Parts of a model that OpenSCAD itself evaluates, with a program made of a function.
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <sstream>

#include "formats/openscad/reading.hpp"
#include "geometry/aabb.hpp"
#include "process/temporary_folder.hpp"

namespace graycube {
namespace {

using testing::scene_of;

/// Answers by a function of the part's text, and counts.
struct Program : OpenscadProgram {
  explicit Program(std::function<Result(const std::string&)> how) : answer(std::move(how)) {}

  Result evaluate(const std::string& csg, Format) override { return answer(csg); }
  std::vector<Result> evaluate_all(std::span<const Part> parts, Format format) override {
    ++runs;
    asked.insert(asked.end(), parts.begin(), parts.end());
    return OpenscadProgram::evaluate_all(parts, format);
  }

  std::function<Result(const std::string&)> answer;
  int runs = 0;
  std::vector<Part> asked;
};

/// A tetrahedron of this size with one corner at (x, y, 0), in six digits.
std::string tetrahedron(double x, double y, double size) {
  std::ostringstream off;
  off << std::setprecision(6) << "OFF 4 4 0\n"
      << x << ' ' << y << " 0\n"
      << x + size << ' ' << y << " 0\n"
      << x << ' ' << y + size << " 0\n"
      << x << ' ' << y << ' ' << size << "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  return off.str();
}

OpenscadProgram::Result square_of_svg(const std::string&) {
  return {"<svg><path d=\"M 0,0 L 2,0 L 2,-2 L 0,-2 z\"/></svg>", {}};
}

OpenscadResult read(const std::string& text, OpenscadProgram* program,
                    const std::string& folder = {}) {
  OpenscadOptions options;
  options.program = program;
  options.folder = folder;
  return read_openscad_csg(text, options);
}

std::string warnings_of(const OpenscadResult& result) {
  std::string text;
  for (const ImportWarning& w : result.warnings)
    text += w.where + ": " + w.text + (w.leaves_out ? " [left out]\n" : "\n");
  return text;
}

Aabb box_of(const Scene& scene) {
  Aabb box = Aabb::nothing();
  for (const SceneObject& object : scene.objects) {
    const auto& mesh = std::get<MeshShape>(object.csg.value).mesh;
    for (const Vec3& p : mesh.points)
      box.include(object.csg.transform ? object.csg.transform->point(p) : p);
  }
  return box;
}

TEST_CASE("all solids that the program evaluates are asked for in one run, each text once") {
  Program program([](const std::string&) {
    return OpenscadProgram::Result{tetrahedron(0, 0, 1), {}};
  });
  std::string text;
  for (int i = 0; i < 5; ++i)
    text += "minkowski() { surface(file = \"" + std::to_string(i % 3) + ".dat\"); sphere(1); }\n";
  const OpenscadResult result = read(text, &program);
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 5);
  CHECK(program.runs == 1);
  REQUIRE(program.asked.size() == 3);
  CHECK(program.asked[1].name == "minkowski() of line 2");
}

TEST_CASE("a part that only shows when another is known is asked for in a second run") {
  // Whether the sum is that of convex figures can be told only with the text's figure.
  Program program(square_of_svg);
  const std::string text =
      "linear_extrude(height = 1) minkowski() { text(text = \"a\"); circle(r = 1); }\n";
  const OpenscadResult result = read(text, &program);
  REQUIRE(result.scene);
  CHECK(program.runs <= 2);
  CHECK(result.scene->objects.size() == 1);
}

TEST_CASE("one part that can't be made is left out, with its line and the program's words") {
  Program program([](const std::string& csg) {
    if (csg.find("bad") != std::string::npos)
      return OpenscadProgram::Result{{}, "openscad: ERROR: no luck"};
    return OpenscadProgram::Result{tetrahedron(0, 0, 1), {}};
  });
  const OpenscadResult result = read(
      "cube(1);\nminkowski() { surface(file = \"bad\"); }\nminkowski() { surface(); }\n", &program);
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 2);
  CHECK(warnings_of(result).find(
            "line 2: minkowski() is left out: openscad: ERROR: no luck [left out]\n") !=
        std::string::npos);
  const OpenscadResult nothing = read("minkowski() { surface(file = \"bad\"); }\n", &program);
  REQUIRE(nothing.errors.size() == 1);
  CHECK(nothing.errors[0].message == "nothing is left of the model");
}

TEST_CASE("what the program warns of is told, also where it makes something") {
  Program program([](const std::string&) {
    return OpenscadProgram::Result{tetrahedron(0, 0, 1), {}, {"WARNING: Can't open it"}};
  });
  const OpenscadResult result = read("minkowski() { surface(); }", &program);
  REQUIRE(result.scene);
  CHECK(warnings_of(result).find("line 1: minkowski(): openscad: WARNING: Can't open it\n") !=
        std::string::npos);
}

TEST_CASE("nothing is asked for what is nothing: an empty text, operations on nothing") {
  Program program(square_of_svg);
  for (const char* text : {"linear_extrude(height = 1) text(text = \"\");", "offset(r = 1);",
                           "hull();", "minkowski();", "resize(newsize = [1, 1, 1]) { group(); }",
                           "linear_extrude(height = 1);"}) {
    INFO(text);
    const OpenscadResult result = read(std::string("cube(1);\n") + text, &program);
    REQUIRE(result.scene);
    CHECK(result.scene->objects.size() == 1);
    CHECK(warnings_of(result).empty());
  }
  CHECK(program.runs == 0);
}

TEST_CASE("a solid far from the origin is evaluated near it, and keeps its digits") {
  // 1/3 of a unit at a million is lost in six digits.
  const double far = 1e6 + 1.0 / 3, size = 1.0 / 7;
  Program program([&](const std::string& csg) {
    double x = 0, y = 0;
    if (csg.starts_with("translate(["))
      std::istringstream(csg.substr(11)) >> x >> std::ws >> std::skipws;
    const std::size_t comma = csg.find(", ");
    if (csg.starts_with("translate([")) y = std::stod(csg.substr(comma + 2));
    return OpenscadProgram::Result{tetrahedron(far + x, 5 + y, size), {}};
  });
  const OpenscadResult result = read("minkowski() { surface(); }", &program);
  REQUIRE(result.scene);
  CHECK(program.runs == 2);
  const Aabb box = box_of(*result.scene);
  CHECK(box.lo.x == Approx(far).margin(1e-5));
  CHECK(box.hi.x - box.lo.x == Approx(size).epsilon(1e-4));
  CHECK(box.hi.y - box.lo.y == Approx(size).epsilon(1e-4));
}

TEST_CASE("a solid near the origin is evaluated once, and stays as it was written") {
  Program program([](const std::string&) {
    return OpenscadProgram::Result{tetrahedron(20, 0, 10), {}};
  });
  const OpenscadResult result = read("minkowski() { surface(); }", &program);
  REQUIRE(result.scene);
  CHECK(program.runs == 1);
  CHECK(box_of(*result.scene).lo.x == 20);
}

TEST_CASE("files of import() in STL and OFF are read here, with all their digits") {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.OFF") << "OFF 4 4 0\n500000.123456 0 0\n500001 0 0\n500000 1 0\n"
                                     "500000 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  Program program(square_of_svg);
  const OpenscadResult result = read(
      "multmatrix([[1, 0, 0, -500000], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) import(file = "
      "\"a.OFF\");",
      &program, folder.path().string());
  REQUIRE(result.scene);
  CHECK(program.runs == 0);
  CHECK(warnings_of(result).empty());
  CHECK(box_of(*result.scene).hi.x == Approx(1));
}

TEST_CASE("a file that is missing, or no mesh, leaves its part out and no other") {
  const TemporaryFolder folder;
  std::ofstream(folder / "open.off") << "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  Program program(square_of_svg);
  const OpenscadResult result = read(
      "cube(1);\nimport(file = \"none.stl\");\nlinear_extrude(height = 1) import(file = "
      "\"none.dxf\");\nsurface(file = \"none.png\");\nimport(file = \"open.off\");\n",
      &program, folder.path().string());
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 1);
  CHECK(program.runs == 0);
  const std::string told = warnings_of(result);
  for (const char* line :
       {"line 2: import() of none.stl is left out: there is no such file [left out]\n",
        "line 3: import() of none.dxf is left out: there is no such file [left out]\n",
        "line 4: surface() of none.png is left out: there is no such file [left out]\n",
        "line 5: import() of open.off is left out: "}) {
    INFO(told);
    CHECK(told.find(line) != std::string::npos);
  }
}

TEST_CASE("faces that a mesh file has twice don't leave its part out, which is told") {
  const TemporaryFolder folder;
  std::ofstream(folder / "twice.off")
      << "OFF 4 6 0\n0 0 0\n4 0 0\n0 4 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 2 1 0\n"
         "3 1 0 2\n";
  Program program(square_of_svg);
  const OpenscadResult result =
      read("cube(1);\nimport(file = \"twice.off\");\n", &program, folder.path().string());
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 2);
  CHECK_THAT(warnings_of(result), Catch::StartsWith("line 2: import() of twice.off: ") &&
                                      Catch::Contains("dropped 2 faces") &&
                                      !Catch::Contains("[left out]"));
}

TEST_CASE("extrusions that name a drawing extrude it, with its layer, origin and scale") {
  Program program(square_of_svg);
  const OpenscadResult result = read(
      "linear_extrude(file = \"a.dxf\", layer = \"b\", origin = [1, 2], height = 3, scale = [1, "
      "1], "
      "timestamp = 7);\nrotate_extrude(file = \"a.dxf\", scale = 2, angle = 360, $fn = 8);\n",
      &program);
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 2);
  REQUIRE(program.asked.size() == 2);
  CHECK(program.asked[0].csg ==
        "import(file = \"a.dxf\", layer = \"b\", origin = [1, 2], scale = 1);\n");
  CHECK(program.asked[1].csg == "import(file = \"a.dxf\", scale = 2, $fn = 8);\n");
  const auto* prism = std::get_if<PrismShape>(&result.scene->objects[0].csg.value);
  const auto* box = std::get_if<BoxShape>(&result.scene->objects[0].csg.value);
  CHECK((prism != nullptr ? prism->height : box != nullptr ? box->max.z : 0) == 3);
}

TEST_CASE("a text with quotes goes to the program as it is, with the quotes escaped") {
  Program program(square_of_svg);
  for (const auto& [written, asked] :
       {std::pair{R"(a",b)", R"("a\",b")"}, {R"(say "hi")", R"("say \"hi\"")"}}) {
    program.asked.clear();
    const OpenscadResult result =
        read("linear_extrude(height = 1) text(text = \"" + std::string(written) + "\", size = 10);",
             &program);
    INFO(written);
    REQUIRE(result.scene);
    REQUIRE(program.asked.size() == 1);
    CHECK(program.asked[0].csg == "text(text = " + std::string(asked) + ", size = 10);\n");
  }
}

TEST_CASE("a model's own view is its camera") {
  OpenscadOptions options;
  options.frame.image = {200, 100, 1};
  options.view = OpenscadView{{1, 2, 3}, {90, 0, 90}, 10, 90};
  const Camera& camera = scene_of("cube(1);", options).settings.camera;
  // Turned by 90° about x and z, who looked down from z looks from x.
  CHECK(camera.look_at == Vec3{1, 2, 3});
  CHECK(camera.eye == Vec3{11, 2, 3});
  CHECK(camera.up == Vec3{0, 0, 1});
  CHECK(camera.fov_degrees == Approx(126.8698976));
  options.view->distance = 0;
  OpenscadResult result = read_openscad_csg("cube(1);", options);
  REQUIRE(result.scene);
  CHECK(result.scene->settings.camera.fov_degrees == 30);
  CHECK(warnings_of(result).find("no camera is as $vpt") != std::string::npos);
}

}  // namespace
}  // namespace graycube
