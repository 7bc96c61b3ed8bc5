// Nets of Bézier patches in scene files: read, written back, refused with their place, and compiled
// to the mesh that bezier/net_mesh.hpp makes of them.
#include <string>
#include <variant>
#include <vector>

#include "bezier/samples.hpp"
#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "scene/bezier_solid.hpp"
#include "scene/compile_scene.hpp"
#include "scene/limits.hpp"
#include "scene/scene_fault.hpp"
#include "scene_text.hpp"

using namespace graycube;
using graycube::testing::cube_net;
using graycube::testing::SceneText;

namespace {

/// A scene of one object, which is this net.
Scene scene_of(const BezierNet& net, double tolerance = 0) {
  Scene scene;
  scene.settings.camera.eye = {0, 0, -9};
  scene.settings.camera.up = {0, 1, 0};
  scene.settings.camera.fov_degrees = 40;
  scene.settings.image = {4, 4, 1};
  scene.materials = {{"m", {}}};
  scene.objects = {{"net", 0, {BezierShape{net, tolerance}, std::nullopt, kInheritMaterial}}};
  return scene;
}
ReadResult read_back(const Scene& scene) { return read_scene_text(write_scene_text(scene)); }

std::string listed(const std::vector<SceneError>& errors) {
  std::string text;
  for (const SceneError& e : errors) text += e.pointer + ": " + e.message + "\n";
  return text;
}
std::string errors_of(const std::string& csg) {
  return listed(read_scene_text(SceneText::of_csg(csg).text()).errors);
}
/// A tolerance that takes somewhat more triangles than that.
double tolerance_for(const BezierNet& net, std::uint64_t triangles) {
  for (double tolerance = 1;; tolerance *= 0.9) {
    const auto division = division_of(net, tolerance);
    REQUIRE(std::holds_alternative<BezierDivision>(division));
    if (std::get<BezierDivision>(division).triangles > triangles) return tolerance;
  }
}
/// A net of three points with one patch, in JSON.
std::string one_patch(const std::string& numbers, const std::string& more = "") {
  return R"({"type": "bezier", "points": [[0,0,0],[1,0,0],[0,1,0]], "patches": [[)" + numbers +
         "]]" + more + "}";
}

}  // namespace

TEST_CASE("a net of patches reads back as it was written, with or without a tolerance") {
  for (const double tolerance : {0.0, 0.0625, 1e-3}) {
    const Scene scene = scene_of(cube_net(0.2, 9), tolerance);
    const ReadResult read = read_back(scene);
    INFO(listed(read.errors));
    REQUIRE(read.scene);
    CHECK(read.scene->objects == scene.objects);
  }
}

TEST_CASE("a net is compiled to a mesh within its tolerance") {
  const auto mesh_with = [](double tolerance) {
    const Model model = compile_scene(scene_of(cube_net(0.2, 9), tolerance));
    REQUIRE(model.meshes.size() == 1);
    return model.meshes.front().surface();
  };
  const BezierNet net = cube_net(0.2, 9);
  CHECK(mesh_with(0.01) == std::get<TriangleMesh>(mesh_of(net, 0.01)));
  CHECK(mesh_with(0) == std::get<TriangleMesh>(mesh_of(net, default_tolerance(net))));
  CHECK(mesh_with(0.001).triangles.size() > 2 * mesh_with(0.01).triangles.size());
}

TEST_CASE("copies of a net are the same mesh moved") {
  Scene scene = scene_of(cube_net(0.2, 9), 0.05);
  RepeatNode repeat;
  repeat.child.push_back(scene.objects[0].csg);
  repeat.maps = {translation({4, 0, 0})};
  repeat.depth = 2;
  scene.objects[0].csg.value = std::move(repeat);
  const Model model = compile_scene(scene);
  REQUIRE(model.meshes.size() == 3);
  CHECK(model.meshes[2].surface().triangles == model.meshes[0].surface().triangles);
  CHECK(model.meshes[2].surface().points[5] == model.meshes[0].surface().points[5] + Vec3{8, 0, 0});
}

TEST_CASE("what is wrong with a net is told with its place") {
  const std::string csg = "/objects/0/csg";
  const std::string zeros = "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,";
  CHECK(errors_of(one_patch(zeros + "3")).starts_with(csg + "/patches/0/15: expected"));
  CHECK(errors_of(one_patch(zeros + "0,0")) ==
        csg +
            "/patches/0: expected a patch of 16 numbers of points, found "
            "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]\n");
  CHECK(errors_of(one_patch(zeros + "0", R"(, "tolerance": 0)"))
            .starts_with(csg + "/tolerance: expected a finite number > 0"));
  CHECK(errors_of(one_patch(zeros + "0", R"(, "tolerence": 1)"))
            .find("did you mean \"tolerance\"?") != std::string::npos);
  CHECK(errors_of(R"({"type": "bezier", "points": [], "patches": []})")
            .starts_with(csg + "/patches: expected 1 to 65536 patches"));
  CHECK(errors_of(R"({"type": "bezier", "points": [], "patches": [[)" + zeros + "0]]}")
            .starts_with(csg + "/patches: expected points for the patches"));
  CHECK(errors_of(one_patch("0,0,1,1,0,0,1,1,0,0,2,2,0,0,2,2"))
            .starts_with(csg + "/patches: the patches are not closed: the side of patch 0 "));
}

TEST_CASE("triangles of nets count before they are made, also where repeats copy them") {
  const BezierNet net = cube_net(0.2, 9);
  // More than half of what all meshes may have together.
  Scene scene = scene_of(net, tolerance_for(net, kMaxMeshTriangles / 2));
  CHECK(read_back(scene).errors.empty());
  scene.objects.push_back(scene.objects[0]);
  CHECK(listed(read_back(scene).errors)
            .starts_with("/objects/1/csg: the meshes have more than 8388608 points or 8388608 "
                         "triangles together"));
  scene = scene_of(net, tolerance_for(net, kMaxRepeatedTriangles / 30));
  RepeatNode repeat;
  repeat.child.push_back(scene.objects[0].csg);
  repeat.maps.assign(2, Affine{});
  repeat.depth = 4;
  scene.objects[0].csg.value = std::move(repeat);
  CHECK(listed(read_back(scene).errors).find(" triangles of meshes, at most 2097152") !=
        std::string::npos);
}

TEST_CASE("patches of nothing but one point are told before anything is traced") {
  BezierNet net = cube_net();
  for (Vec3& p : net.points) p = {};
  const ReadResult read = read_back(scene_of(net));
  INFO(listed(read.errors));
  REQUIRE(read.scene);
  try {
    compile_scene(*read.scene);
    FAIL("a point was compiled");
  } catch (const UnrenderableScene& e) {
    REQUIRE(e.faults().size() == 1);
    CHECK(e.faults()[0].pointer == "/objects/0/csg");
    CHECK(e.faults()[0].message.starts_with("the bezier of \"net\" encloses no solid: "));
  }
}
