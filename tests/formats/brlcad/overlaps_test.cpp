#include "formats/brlcad/overlaps.hpp"

#include <string>

#include "model.hpp"
#include "reading.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

std::string region(const std::string& name, const std::string& solid) {
  return v4_region(name) + v4_member('u', solid);
}

}  // namespace

TEST_CASE("regions that fill the same space are found, with a point in both") {
  const Scene scene = scene_of(kV4Head + v4_sphere("s", 0, 0, 0, 10) + v4_sphere("t", 5, 0, 0, 10) +
                               v4_sphere("u", 40, 0, 0, 5) + region("a", "s") + region("b", "t") +
                               region("c", "u"));
  const BrlcadOverlaps overlaps = find_brlcad_overlaps(compile_scene(scene));
  REQUIRE(overlaps.pairs.size() == 1);
  CHECK(overlaps.is_whole);
  const BrlcadOverlap& o = overlaps.pairs[0];
  CHECK(scene.objects[o.first].name == "a");
  CHECK(scene.objects[o.second].name == "b");
  CHECK(length(o.point) < 10);
  CHECK(length(o.point - Vec3{5, 0, 0}) < 10);
  CHECK(o.depth > 10);
  CHECK(o.depth <= 20);
}

TEST_CASE("regions that touch, or lie in each other's cavities, don't overlap") {
  // A ball in a block's cavity of the same size, and a block flush with that block.
  const Scene scene =
      scene_of(kV4Head + v4_box("b", 0, 0, 0, 20, 20, 20) + v4_box("n", 20, 0, 0, 5, 20, 20) +
               v4_sphere("s", 10, 10, 10, 4) + v4_region("block") + v4_member('u', "b") +
               v4_member('-', "s") + region("ball", "s") + region("next", "n"));
  REQUIRE(scene.objects.size() == 3);
  CHECK(find_brlcad_overlaps(compile_scene(scene)).pairs.empty());
}

TEST_CASE("a thin overlap of two plates is found whichever way it lies") {
  for (int axis = 0; axis < 3; ++axis) {
    double at[3] = {0, 0, 0};
    at[axis] = 19.99;
    const Scene scene = scene_of(kV4Head + v4_box("a", 0, 0, 0, 20, 20, 20) +
                                 v4_box("b", at[0], at[1], at[2], 20, 20, 20) + region("ra", "a") +
                                 region("rb", "b"));
    const BrlcadOverlaps overlaps = find_brlcad_overlaps(compile_scene(scene));
    REQUIRE(overlaps.pairs.size() == 1);
    CHECK(overlaps.pairs[0].depth == Approx(0.01).epsilon(1e-6));
  }
}
