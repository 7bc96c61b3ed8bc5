// Brute force must find what depths promise, light or darkness.
#include "visibility/light_depths.hpp"

#include <cmath>

#include "catch.hpp"
#include "csg/random_model.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint64_t kTexels = 60'000;

PointLight light_at(const Vec3& p) { return {p, {1, 1, 1}, Falloff::kNone}; }

/// Whether light comes from `light` to `point`, as found by a shadow ray that starts at the point.
bool light_comes(const SurfaceTree& tree, const Vec3& light, const Vec3& point) {
  const double distance = length(light - point);
  const double epsilon = 1e-9 * std::max(1.0, max_abs(point));
  TreeScratch scratch;
  Rgb rgb{1, 1, 1};
  return tree.pass_light({point, normalized(light - point)}, epsilon, distance - epsilon, scratch,
                         rgb);
}

/// A picture of a scene from aside.
Scene seen(Scene scene, std::vector<PointLight> lights) {
  scene.settings.lights = std::move(lights);
  scene.settings.camera = {};
  scene.settings.camera.eye = {0.3, -20, 3.1};
  scene.settings.camera.look_at = {0, 0, 0};
  scene.settings.camera.up = {0, 0, 1};
  scene.settings.camera.fov_degrees = 40;
  scene.settings.image.width = scene.settings.image.height = 64;
  return scene;
}

}  // namespace

TEST_CASE("depths promise light and darkness only where it is") {
  std::uint64_t tried = 0, with_block = 0, farther = 0, dark = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Dice dice(seed);
    RandomOptions options;
    options.unbounded = dice.one_in(3);
    std::vector<PointLight> lights;
    // Lights far away, near, and inside solids.
    for (const double spread : {14.0, 6.0, 2.0}) lights.push_back(light_at(dice.point(spread)));
    const Scene scene = seen(RandomModel(seed, options).scene(), lights);
    const Model model = compile_scene(scene);
    const SurfaceTree tree = SurfaceTree::build(model);
    const LightHorizons coarse = LightHorizons::of(model);
    const LightHorizons horizons = with_depths(coarse, tree, kTexels);
    REQUIRE(horizons.maps() == coarse.maps());
    for (std::size_t light = 0; light < lights.size(); ++light) {
      const Vec3& at = lights[light].position;
      for (int i = 0; i < 400; ++i) {
        // Mostly towards the middle, where the solids are.
        const Vec3 towards = dice.one_in(4) ? at + dice.unit_vector() : dice.point(3);
        if (!(length(towards - at) > 0)) continue;
        const Vec3 d = normalized(towards - at);
        const LightHorizons::Reach reach = horizons.toward(light, d);
        INFO("seed " << seed << ", light " << light << ", direction " << d.x << ' ' << d.y << ' '
                     << d.z);
        if (reach.clearance == 0) REQUIRE(reach.lit == coarse.distance(light, d));
        TreeScratch scratch;
        const auto hit = tree.first_crossing({at, d}, 0, kInf, scratch);
        REQUIRE(reach.lit <= (hit ? hit->t : kInf));
        ++tried;
        if (reach.clearance > 0) ++with_block;
        if (reach.lit > coarse.distance(light, d)) ++farther;
        if (!std::isfinite(reach.dark)) continue;
        for (const double beyond : {1e-6, 0.1, dice.between(0, 10)}) {
          REQUIRE_FALSE(light_comes(tree, at, at + (reach.dark + beyond) * d));
        }
        ++dark;
      }
    }
  }
  CHECK(with_block > 5000);
  CHECK(farther > 1000);
  CHECK(dark > 1000);
}

TEST_CASE("behind a wall it is dark, before it light, and glass makes no darkness") {
  Scene scene = scene_of(
      {node_of(BoxShape{{-3, -3, 0}, {3, 3, 1}}), node_of(BoxShape{{-8, -8, -6}, {8, 8, -5}})});
  scene = seen(scene, {light_at({0, 0, 10})});
  const Vec3 down{0, 0, -1};
  const auto reach_of = [&](const Scene& s) {
    const Model model = compile_scene(s);
    return with_depths(LightHorizons::of(model), SurfaceTree::build(model), 200'000)
        .toward(0, down);
  };
  const LightHorizons::Reach wall = reach_of(scene);
  CHECK(wall.lit > 8.5);
  CHECK(wall.lit <= 9);
  CHECK(wall.dark > 9);
  CHECK(wall.dark < 9.5);
  scene.materials.front().material.transmit = 0.5;
  const LightHorizons::Reach glass = reach_of(scene);
  CHECK(glass.lit == wall.lit);
  CHECK(glass.dark == kInf);
}

TEST_CASE("no texels, no depths") {
  const Scene scene =
      seen(scene_of({node_of(BoxShape{{-3, -3, 0}, {3, 3, 1}})}), {light_at({0, 0, 10})});
  const Model model = compile_scene(scene);
  const SurfaceTree tree = SurfaceTree::build(model);
  const LightHorizons coarse = LightHorizons::of(model);
  CHECK(with_depths(coarse, tree, 0).depths().empty());
  CHECK(with_depths(LightHorizons{}, tree, kTexels).is_empty());
  const LightHorizons few = with_depths(coarse, tree, 3000);
  REQUIRE(few.depths().size() == 1);
  CHECK(few.depths().front().dark.size() > 0);
  CHECK(few.depths().front().dark.size() <= 3000);
}

TEST_CASE("a lamp that something is close to has no depths") {
  const Scene scene = seen(
      scene_of({node_of(SphereShape{{0, 0, 0}, 1}), node_of(BoxShape{{-8, -8, -6}, {8, 8, -5}})}),
      {light_at({0, 0, 1.0001}), light_at({0, -9, 9})});
  const Model model = compile_scene(scene);
  const LightHorizons horizons =
      with_depths(LightHorizons::of(model), SurfaceTree::build(model), kTexels);
  REQUIRE(horizons.depths().size() == 2);
  CHECK(horizons.depths().front().split == 0);
  CHECK(horizons.depths().back().split > 0);
}
