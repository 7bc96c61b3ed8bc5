#include "trace/coarse_load.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

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
