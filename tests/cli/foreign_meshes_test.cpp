// Mesh files that another program reads.
#include "cli/foreign_meshes.hpp"

#include <unistd.h>

#include <numbers>

#include "catch.hpp"
#include "cli/expect_failure.hpp"
#include "cli/foreign_mesh_samples.hpp"
#include "cli/scene_input.hpp"
#include "cli/temporary_folder.hpp"
#include "mesh/close_mesh.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

bool is_built() { return ::access(mesh_reader_program().c_str(), X_OK) == 0; }

struct ReadBox {
  std::size_t objects;
  double volume;
  Vec3 lo, hi;
};

/// What the file's meshes enclose.
ReadBox read_box(const std::filesystem::path& path, const ModelChoice& choice = {}) {
  const SceneInput input = read_scene_input(path, {}, choice);
  ReadBox box{input.scene.objects.size(), 0, {1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
  for (const SceneObject& o : input.scene.objects) {
    const TriangleMesh& mesh = std::get<MeshShape>(o.csg.value).mesh;
    box.volume += enclosed_volume(mesh);
    for (const Vec3& p : mesh.points) {
      for (int a = 0; a < 3; ++a) {
        box.lo[a] = std::min(box.lo[a], p[a]);
        box.hi[a] = std::max(box.hi[a], p[a]);
      }
    }
  }
  return box;
}

std::filesystem::path program(const TemporaryFolder& folder, const std::string& text) {
  const auto path = write_file(folder / "reader", "#!/bin/sh\n" + text);
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}
std::string why(const std::variant<std::vector<MeshPart>, MeshFault>& read) {
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}

}  // namespace

TEST_CASE("a box is the same in every format, with z up") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.obj", obj_points() + obj_faces(0, 12)},
      {"a.PLY", ply_text()},
      {"a.amf", amf_text()},
      {"z.dae", dae_text("Z_UP")},
      {"z.fbx", fbx_text(kFbxZUp)},
      {"bom.obj", "\xEF\xBB\xBF" + obj_points() + obj_faces(0, 12)},
  };
  for (const auto& [name, text] : files) {
    INFO(name);
    const ReadBox box = read_box(write_file(folder / name, text));
    CHECK(box.objects == 1);
    CHECK(box.volume == Approx(6));
    CHECK(box.lo == Vec3{0, 0, 0});
    CHECK(box.hi == Vec3{1, 2, 3});
  }
}

TEST_CASE("where y is up in a file, the box is turned") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> files{{"y.dae", dae_text("Y_UP")},
                                                               {"a.x3d", x3d_text()},
                                                               {"y.fbx", fbx_text(kFbxYUp)},
                                                               {"no.fbx", fbx_text({9, 9, 9})}};
  for (const auto& [name, text] : files) {
    INFO(name);
    const ReadBox box = read_box(write_file(folder / name, text));
    CHECK(box.volume == Approx(6));
    CHECK(box.lo == Vec3{0, -3, 0});
    CHECK(box.hi == Vec3{1, 0, 2});
  }
}

TEST_CASE("an FBX's axes, and the places of its nodes, are as it says") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  // x is up, y to the right, −z away from the front.
  const ReadBox up = read_box(write_file(folder / "x.fbx", fbx_text({0, 1, 2, 1, 1, 1})));
  CHECK(up.volume == Approx(6));
  CHECK(up.lo == Vec3{0, -3, 0});
  CHECK(up.hi == Vec3{2, 0, 1});
  const std::string placed =
      "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",10,0,0\n"
      "P: \"Lcl Rotation\", \"Lcl Rotation\", \"\", \"A\",0,0,180\n"
      "P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",1,0,0\n"
      "P: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",2,1,-1\n";
  const ReadBox moved = read_box(write_file(folder / "m.fbx", fbx_text(kFbxZUp, placed)));
  CHECK(moved.volume == Approx(12));
  // Twice as long from x = 0 to 2, half a turn about x = 1, and 10 further.
  CHECK(length(moved.lo - Vec3{10, -2, -3}) < 1e-5);
  CHECK(length(moved.hi - Vec3{12, 0, 0}) < 1e-5);
}

TEST_CASE("an FBX with an index that isn't there, or without any face's end, is an error") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  for (const char* quads : {"0,2,3,-99", "0,2,3,1", ""}) {
    INFO(quads);
    const auto path = write_file(folder / "wrong.fbx", fbx_text(kFbxZUp, "", quads));
    CHECK_THAT(refusal([&] { read_scene_input(path); }), Catch::Contains("wrong.fbx: "));
  }
  const std::string whole = fbx_text(kFbxZUp);
  for (const std::size_t part : {std::size_t{30}, whole.size() / 2, whole.size() * 3 / 4}) {
    const auto path = write_file(folder / "cut.fbx", whole.substr(0, part));
    CHECK_THAT(refusal([&] { read_scene_input(path); }), Catch::Contains("cut.fbx: "));
  }
}

TEST_CASE("cones and cylinders whose last side lies on the first are repaired") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  // assimp 5.2.5 sums up the angle of a cylinder's sides in 24 bits, and goes one too far.
  const std::vector<std::pair<std::string, double>> shapes{
      {R"(<Cylinder radius="2" height="3"/>)", 12 * std::numbers::pi},
      {R"(<Cone bottomRadius="2" height="3"/>)", 4 * std::numbers::pi},
      {R"(<Sphere radius="2"/>)", 32 * std::numbers::pi / 3}};
  ModelChoice choice;
  choice.repairs = true;
  for (const auto& [shape, volume] : shapes) {
    INFO(shape);
    const auto path = write_file(
        folder / "round.x3d", R"(<?xml version="1.0"?><X3D version="3.0"><Scene><Shape>)" + shape +
                                  "</Shape></Scene></X3D>");
    CHECK(read_box(path, choice).volume == Approx(volume).epsilon(0.05));
  }
}

TEST_CASE("nodes and items of a build move and mirror what they hold") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  const ReadBox gltf = read_box(write_file(folder / "a.gltf", gltf_text()));
  CHECK(gltf.volume == Approx(48));
  CHECK(gltf.lo == Vec3{10, -6, 0});
  CHECK(gltf.hi == Vec3{12, 0, 4});
  const ReadBox mirrored = read_box(write_file(folder / "a.3mf", threemf_bytes()));
  CHECK(mirrored.volume == Approx(6));
  CHECK(mirrored.lo == Vec3{10, 0, -3});
  CHECK(mirrored.hi == Vec3{11, 2, 0});
}

TEST_CASE("a body of two materials is one object, and one in the colour of its material") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  write_file(folder / "a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const auto path =
      write_file(folder / "a.obj", "mtllib a.mtl\no part\n" + obj_points() + "usemtl red\n" +
                                       obj_faces(0, 5) + "usemtl blue\n" + obj_faces(5, 12));
  const SceneInput input = read_scene_input(path);
  REQUIRE(input.scene.objects.size() == 1);
  CHECK(input.scene.objects[0].name == "part");
  CHECK(input.warnings.empty());
  const Material& material = input.scene.materials.at(input.scene.objects[0].material).material;
  CHECK(material.color == Rgb{1, 0, 0});
}

TEST_CASE("an open mesh of several is left out, refused, or repaired, as the options say") {
  if (!is_built()) return;
  const TemporaryFolder folder;
  std::string two = "o whole\n" + obj_points() + obj_faces(0, 12) + "o open\n";
  two += joined(kBoxPoints,
                [](auto a, auto b, auto c) { return "v 2" + a + " " + b + " " + c + "\n"; });
  for (std::size_t t = 0; t < 10; ++t) {
    two += "f";
    for (const int i : kBoxTriangles[t]) two += " " + std::to_string(i + 9);
    two += "\n";
  }
  const auto path = write_file(folder / "a.obj", two);
  const SceneInput input = read_scene_input(path);
  CHECK(input.scene.objects.size() == 1);
  REQUIRE(input.warnings.size() == 1);
  CHECK(input.warnings[0].where == path.string() + ":open");
  CHECK(input.warnings[0].why.find("left out: not closed: ") == 0);
  ModelChoice choice;
  choice.is_strict = true;
  CHECK(refusal([&] {
          read_scene_input(path, {}, choice);
        }).starts_with("graycube: scene: " + path.string() + ":open: left out: not closed"));
  choice.repairs = true;
  const ReadBox both = read_box(path, choice);
  CHECK(both.objects == 2);
  CHECK(both.volume == Approx(12));
}

TEST_CASE("whatever happens to the program that reads meshes, there is a fault that says so") {
  const TemporaryFolder folder;
  const auto file = write_file(folder / "a.obj", "v 0 0 0\n");
  const auto fault = [&](const std::string& text) {
    return why(read_foreign_meshes(file, program(folder, text)));
  };
  CHECK(fault("kill -SEGV $$") == "assimp failed on it (signal 11)");
  CHECK(fault("kill -XCPU $$") == "assimp took too long to read it");
  CHECK(fault("exit 3") == "assimp failed on it (status 3)");
  CHECK(fault("echo nonsense") == "what was read of it is broken");
  CHECK(fault("exit 0") == "what was read of it is broken");
}

TEST_CASE("a file that can't be read, and a build without the program, are told") {
  const TemporaryFolder folder;
  const auto file = write_file(folder / "a.obj", "v 0 0 0\n");
  CHECK(why(read_foreign_meshes(folder / "none.obj", folder / "none")).find("can't be read") == 0);
  CHECK(why(read_foreign_meshes(file, folder / "none")).find("libassimp-dev") != std::string::npos);
  if (!is_built()) return;
  CHECK(refusal([&] {
          read_scene_input(write_file(folder / "b.ply", "no such thing"));
        }).find("assimp: ") != std::string::npos);
  CHECK(refusal([&] {
          read_scene_input(file);
        }).starts_with("graycube: scene: " + file.string() + ": "));
}
