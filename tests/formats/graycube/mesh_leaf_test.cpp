// Meshes in scene files, and the files that hold one mesh.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/scene_text.hpp"
#include "formats/graycube/write_scene.hpp"
#include "formats/mesh/off.hpp"
#include "formats/mesh/stl.hpp"
#include "formats/mesh/stl_samples.hpp"
#include "formats/pov/write_pov.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr const char* kTetrahedron =
    R"({"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]})";

const TriangleMesh& mesh_of(const Scene& scene) {
  return std::get<MeshShape>(scene.objects.at(0).csg.value).mesh;
}

std::string first_error(const std::string& csg) {
  const ReadResult read = read_scene_text(SceneText::of_csg(csg).text());
  REQUIRE_FALSE(read.scene);
  return read.errors.at(0).pointer + ": " + read.errors.at(0).message;
}

std::variant<PolygonMesh, MeshFault> read_one_stl(std::string_view bytes) {
  auto read = read_stl(bytes);
  if (auto* fault = std::get_if<MeshFault>(&read)) return *fault;
  return united(std::get<std::vector<MeshPart>>(read));
}

std::string why(const std::variant<PolygonMesh, MeshFault>& read) {
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("graycube-mesh-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace

TEST_CASE("a mesh leaf is read, written and read again as it was") {
  const ReadResult read = read_scene_text(SceneText::of_csg(kTetrahedron).text());
  REQUIRE(read.scene);
  CHECK(mesh_of(*read.scene).points.size() == 4);
  CHECK(mesh_of(*read.scene).triangles.size() == 4);
  CHECK_FALSE(read.used_files);
  const ReadResult again = read_scene_text(write_scene_text(*read.scene));
  REQUIRE(again.scene);
  CHECK(*again.scene == *read.scene);
}

TEST_CASE("a mesh leaf says how many digits its numbers have") {
  const auto with_digits = [](const std::string& digits) {
    std::string csg = kTetrahedron;
    csg.insert(csg.size() - 1, R"(, "digits": )" + digits);
    return csg;
  };
  const ReadResult read = read_scene_text(SceneText::of_csg(with_digits("7")).text());
  REQUIRE(read.scene);
  CHECK(std::get<MeshShape>(read.scene->objects.at(0).csg.value).digits == 7);
  CHECK(read.scene->digits == 0);
  CHECK(first_error(with_digits("18")) ==
        "/objects/0/csg/digits: expected a whole number from 1 to 17, found 18");
  CHECK(first_error(with_digits("0")).find("found 0") != std::string::npos);
}

TEST_CASE("a mesh goes to POV-Ray with an inside") {
  const ReadResult read = read_scene_text(SceneText::of_csg(kTetrahedron).text());
  REQUIRE(read.scene);
  const std::string pov = write_pov(*read.scene).text;
  CHECK(pov.find("mesh2 { vertex_vectors { 4, <0,0,0>") != std::string::npos);
  CHECK(pov.find("inside_vector") != std::string::npos);
}

TEST_CASE("a mesh leaf's mistakes are told where they are") {
  CHECK(first_error(R"({"type": "mesh", "points": []})")
            .find("/objects/0/csg: a mesh needs either the keys") == 0);
  CHECK(first_error(R"({"type": "mesh", "file": "a.stl", "faces": []})").find("either the keys") !=
        std::string::npos);
  CHECK(first_error(R"({"type": "mesh", "file": "/etc/passwd"})")
            .find("/objects/0/csg/file: no file is opened here") == 0);
  CHECK(first_error(R"({"type": "mesh", "points": [[0,0]], "faces": []})")
            .find("/objects/0/csg/points/0: expected a vector") == 0);
  CHECK(first_error(R"({"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,3]]})")
            .find("/objects/0/csg/faces/0/2: expected a whole number from 0 to 2, found 3") == 0);
  CHECK(first_error(R"({"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1]]})")
            .find("/objects/0/csg/faces/0: expected a face of 3 to 131072 corners") == 0);
  CHECK(first_error(R"({"type": "mesh", "points": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,2]]})")
            .find("/objects/0/csg/faces: not closed: the edge from (0, 0, 0) to (1, 0, 0) belongs "
                  "to one face only") == 0);
}

TEST_CASE("uses of one mesh count their triangles each time") {
  // 2^17 uses of a mesh of 16 triangles, two octahedra, are as many as are accepted.
  SceneText text;
  std::string shapes = R"({"m0": {"type": "mesh",
    "points": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1],
               [6,0,0],[4,0,0],[5,1,0],[5,-1,0],[5,0,1],[5,0,-1]],
    "faces": [[0,2,4],[2,1,4],[1,3,4],[3,0,4],[2,0,5],[1,2,5],[3,1,5],[0,3,5],
              [6,8,10],[8,7,10],[7,9,10],[9,6,10],[8,6,11],[7,8,11],[9,7,11],[6,9,11]]})";
  for (int i = 1; i <= 18; ++i) {
    const std::string ref = R"({"type": "ref", "shape": "m)" + std::to_string(i - 1) + "\"}";
    shapes += ", \"m" + std::to_string(i) + R"(": {"type": "union", "children": [)" + ref + "," +
              ref + "]}";
  }
  text.with("shapes", shapes + "}");
  const auto objects = [](int i) {
    return R"([{"material": "red", "csg": {"type": "ref", "shape": "m)" + std::to_string(i) +
           "\"}}]";
  };
  CHECK(read_scene_text(text.with("objects", objects(17)).text()).scene);
  const ReadResult read = read_scene_text(text.with("objects", objects(18)).text());
  REQUIRE(read.errors.size() == 1);
  CHECK(read.errors[0].message.find("4194304 triangles of meshes") != std::string::npos);
}

TEST_CASE("STL of both kinds and OFF give the same mesh") {
  const TriangleMesh box = closed(box_polygons({-1, 0, 2}, {3, 5, 2.5}));
  const auto from_text = read_one_stl(stl_text(box)), from_bytes = read_one_stl(stl_bytes(box));
  REQUIRE(why(from_text).empty());
  REQUIRE(why(from_bytes).empty());
  CHECK(closed(std::get<PolygonMesh>(from_text)) == box);
  CHECK(closed(std::get<PolygonMesh>(from_bytes)) == box);
  const auto off = read_off(
      "OFF # a comment\n8 6 0\n-1 0 2\n3 0 2\n-1 5 2\n3 5 2 # another\n-1 0 2.5\n3 0 2.5\n-1 5 "
      "2.5\n3 5 2.5\n\n"
      "4 0 2 3 1 255 0 0\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5");
  REQUIRE(why(off).empty());
  CHECK(closed(std::get<PolygonMesh>(off)) == box);
  CHECK(std::get<PolygonMesh>(from_bytes).digits == 7);
  CHECK(std::get<PolygonMesh>(from_text).digits == 7);
}

TEST_CASE("a scene's mesh file lies beside it, and travels in its text") {
  const Folder folder;
  const TriangleMesh box = closed(box_polygons({0, 0, 0}, {1, 1, 1}));
  folder.write("part.STL", stl_bytes(box));
  const auto scene = folder.write(
      "scene.json", SceneText::of_csg(R"({"type": "mesh", "file": "part.STL"})").text());
  const ReadResult read = read_scene_file(scene);
  REQUIRE(read.scene);
  CHECK(read.used_files);
  CHECK(mesh_of(*read.scene) == box);
  CHECK(std::get<MeshShape>(read.scene->objects.at(0).csg.value).digits == 7);
  const ReadResult again = read_scene_text(write_scene_text(*read.scene));
  REQUIRE(again.scene);
  CHECK(*again.scene == *read.scene);
  const auto measured = folder.write(
      "measured.json",
      SceneText::of_csg(R"({"type": "mesh", "file": "part.STL", "digits": 5})").text());
  CHECK(
      std::get<MeshShape>(read_scene_file(measured).scene.value().objects.at(0).csg.value).digits ==
      5);
  const auto missing = folder.write(
      "missing.json", SceneText::of_csg(R"({"type": "mesh", "file": "none.off"})").text());
  const ReadResult refused = read_scene_file(missing);
  REQUIRE(refused.errors.size() == 1);
  CHECK(refused.errors[0].pointer == "/objects/0/csg/file");
  CHECK(refused.errors[0].message.find("none.off: can't be read") != std::string::npos);
}
