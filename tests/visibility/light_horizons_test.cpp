// A horizon must never promise light where brute force finds something in the way.
#include "visibility/light_horizons.hpp"

#include <cmath>

#include "catch.hpp"
#include "crossings/surface_tree.hpp"
#include "csg/random_model.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The distance from the light to the first crossing of any surface in that direction.
double first_surface(const SurfaceTree& tree, const Vec3& light, const Vec3& direction) {
  TreeScratch scratch;
  const auto hit = tree.first_crossing({light, direction}, 0, kInf, scratch);
  return hit ? hit->t : kInf;
}

PointLight light_at(const Vec3& p) { return {p, {1, 1, 1}, Falloff::kNone}; }

}  // namespace

TEST_CASE("nothing lies between a light and its horizon") {
  std::uint64_t promised = 0, open = 0, tried = 0;
  double reach = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    Scene scene = RandomModel(seed).scene();
    scene.settings.lights.clear();
    // Lights far away, near, and inside solids.
    for (const double spread : {12.0, 4.0, 1.0})
      scene.settings.lights.push_back(light_at(dice.point(spread)));
    const Model model = compile_scene(scene);
    const SurfaceTree tree = SurfaceTree::build(model);
    const LightHorizons horizons = LightHorizons::of(model);
    for (std::size_t light = 0; light < scene.settings.lights.size(); ++light) {
      for (int i = 0; i < 200; ++i) {
        Vec3 d = dice.unit_vector();
        // Some directions lie along the axes and the edges between texels and faces.
        if (dice.one_in(8)) d[static_cast<int>(dice.below(3))] = 0;
        if (dice.one_in(8))
          d = {std::round(d.x * 8) / 8, std::round(d.y * 8) / 8, std::round(d.z * 8) / 8};
        if (!(length(d) > 0)) continue;
        d = normalized(d);
        const double horizon = horizons.distance(light, d);
        const double surface = first_surface(tree, scene.settings.lights[light].position, d);
        INFO("light " << light << ", direction " << d.x << ' ' << d.y << ' ' << d.z);
        REQUIRE(horizon <= surface);
        ++tried;
        if (horizon > 0) ++promised;
        if (!std::isfinite(horizon)) ++open;
        if (std::isfinite(surface) && surface > 0) reach += std::min(1.0, horizon / surface);
      }
    }
  }
  CHECK(promised > tried / 10);
  CHECK(open > 1000);
  CHECK(reach > 1000);
}

TEST_CASE("a lamp in a closed room sees as far as the walls") {
  const CsgNode room = operation(
      Operation::kDifference,
      {node_of(BoxShape{{-6, -6, -6}, {6, 6, 6}}), node_of(BoxShape{{-5, -5, -5}, {5, 5, 5}})});
  Scene scene = scene_of({room, node_of(SphereShape{{3, 0, 0}, 1})});
  scene.settings.lights = {light_at({0, 0, 0})};
  const LightHorizons horizons = LightHorizons::of(compile_scene(scene));
  CHECK(horizons.distance(0, {0, 1, 0}) > 4.9);
  CHECK(horizons.distance(0, {0, 1, 0}) <= 5);
  CHECK(horizons.distance(0, {1, 0, 0}) > 1.9);
  CHECK(horizons.distance(0, {1, 0, 0}) <= 2);
}

TEST_CASE("a floor without end is no nearer than it is") {
  Scene scene = scene_of({node_of(HalfSpaceShape{{0, 1, 0}, 0})});
  scene.settings.lights = {light_at({0, 3, 0}), light_at({0, -1, 0})};
  const LightHorizons horizons = LightHorizons::of(compile_scene(scene));
  CHECK(horizons.distance(0, {0, -1, 0}) > 2.99);
  CHECK(horizons.distance(0, {0, -1, 0}) <= 3);
  CHECK(horizons.distance(0, normalized(Vec3{1, -1, 0})) > 4.1);
  CHECK(horizons.distance(0, {0, 1, 0}) == kInf);
  CHECK(horizons.distance(1, {0, 1, 0}) > 0.99);
  CHECK(horizons.distance(2, {0, 1, 0}) == 0);
}

TEST_CASE("a light on a surface has no horizon") {
  Scene scene = scene_of({node_of(SphereShape{{0, 0, 0}, 2})});
  scene.settings.lights = {light_at({2, 0, 0}), light_at({0, 0, 0})};
  const LightHorizons horizons = LightHorizons::of(compile_scene(scene));
  CHECK(horizons.distance(0, {1, 0, 0}) == 0);
  CHECK(horizons.is_empty());
}
