// Matrices around a whole .csg file are kept apart: their rounded numbers move all parts alike.
#include <limits>
#include <string>

#include "catch.hpp"
#include "crossings/surface_tree.hpp"
#include "formats/openscad/reading.hpp"
#include "scene/compile_scene.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kFarAway =
    "multmatrix([[1, 0, 0, 54000], [0, 1, 0, 54000], [0, 0, 1, 20000], [0, 0, 0, 1]]) ";
/// rotate([30, 20, 10]) in six digits.
const std::string kTurned =
    "multmatrix([[0.925417, 0.0180283, 0.378522, 0], [0.163176, 0.882564, -0.44097, 0], "
    "[-0.34202, 0.469846, 0.813798, 0], [0, 0, 0, 1]]) ";
/// A plate with a step of 0.375 mm, beside the origin.
const std::string kStep =
    "union() { cube(size = [100, 100, 10], center = false); multmatrix([[1, 0, 0, 20], [0, 1, 0, "
    "20], [0, 0, 1, 0], [0, 0, 0, 1]]) cube(size = [30, 30, 10.375], center = false); }";

/// The parameter at which a ray from a point above the plate, in its own frame, meets the scene.
double height_below(const Scene& scene, const Affine& to_world, double x, double y) {
  const Model model = compile_scene(scene);
  const SurfaceTree tree = SurfaceTree::build(model);
  TreeScratch scratch;
  const Ray ray{to_world.point({x, y, 50}), normalized(to_world.vector({0, 0, -1}))};
  const auto hit = tree.first_crossing(ray, 0, std::numeric_limits<double>::infinity(), scratch);
  return hit ? hit->t : -1;
}

TEST_CASE("a turned part that is 54 m away keeps its steps of less than half a millimetre") {
  const Affine map = compose(
      translation({54000, 54000, 20000}),
      compose(rotation({0, 0, 1}, 10), compose(rotation({0, 1, 0}, 20), rotation({1, 0, 0}, 30))));
  for (const std::string& text :
       {kFarAway + kTurned + kStep, kFarAway + "color([1, 0, 0, 1]) group() " + kTurned + kStep,
        kFarAway + "group() { " + kTurned + kStep + " " + kTurned + kStep + " }"}) {
    INFO(text);
    const Scene scene = scene_of(text);
    CHECK(scene.digits == 6);
    CHECK(height_below(scene, map, 80, 80) == Approx(40).margin(1e-3));
    CHECK(height_below(scene, map, 35, 35) == Approx(40 - 0.375).margin(1e-3));
  }
}

TEST_CASE("what is around all parts stands at their roots, and nothing else does") {
  const Scene far = scene_of(kFarAway + "{ " + kTurned + "cube(5); cube(3); }");
  REQUIRE(far.objects.size() == 2);
  const Affine away = translation({54000, 54000, 20000});
  for (const SceneObject& object : far.objects) {
    REQUIRE(object.csg.transform);
    CHECK(*object.csg.transform == away);
  }
  // Moved down to the leaves as ever: a ball under a rotation stays a ball.
  CHECK_FALSE(scene_of(kTurned + "sphere(r = 2);").objects[0].csg.transform);
  const Scene two = scene_of(kFarAway + "cube(5); cube(3);");
  REQUIRE(two.objects.size() == 2);
  CHECK(two.objects[0].csg.transform);
  CHECK_FALSE(two.objects[1].csg.transform);
}

TEST_CASE("the camera looks at parts that something moves all together") {
  const Scene scene = scene_of(kFarAway + kTurned + kStep);
  CHECK(scene.settings.camera.look_at.x == Approx(54000).margin(200));
}

}  // namespace
}  // namespace graycube
