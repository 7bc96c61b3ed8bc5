#include "trace/coarse_load.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "csg/random_model.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A ball in a corner of the picture, lit from the eye's side.
Scene corner_scene() {
  Scene scene = scene_of({node_of(SphereShape{{0, 0, 0}, 1})});
  scene.settings.camera.eye = {0, 0, -10};
  scene.settings.camera.look_at = {3, 2, 0};
  scene.settings.camera.up = {0, 1, 0};
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 60;
  scene.settings.image = {128, 96, 1};
  scene.settings.lights = {{{1, 3, -9}, {1, 1, 1}, Falloff::kNone},
                           {{-1, 2, -9}, {1, 1, 1}, Falloff::kNone}};
  return scene;
}

double total(const LoadMap& map) { return std::accumulate(map.load.begin(), map.load.end(), 0.0); }

}  // namespace

TEST_CASE("a coarse render finds the work where the solids are") {
  const Model model = compile_scene(corner_scene());
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 8, 8);
  const LoadMap load = coarse_load(Domain(model), grid, nullptr, 0);
  const RegionIndex at = grid.region_of_point({0, 0, 0});
  CHECK(load.at(at.column, at.row) > 1.5 * total(load) / 64);
  // At least the primary rays.
  CHECK(total(load) > kLeastCoarsePixels / 2.0);
  CHECK(total(coarse_load(Domain(model), grid, nullptr, 1)) > total(load));
}

TEST_CASE("balanced boundaries are drawn together where the work is") {
  const Model model = compile_scene(corner_scene());
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const LoadMap load = coarse_load(Domain(model), MacroGrid::regular(frame, 16, 16), nullptr, 0);
  CHECK(heaviest(load, balanced_cuts(load, 4, 4)) < 0.95 * heaviest(load, even_cuts(load, 4, 4)));
}
