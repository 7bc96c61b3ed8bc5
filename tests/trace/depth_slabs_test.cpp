// Macro-regions that are cut in depth give the picture of the whole, bit for bit: primary rays
// travel, too.
#include <algorithm>
#include <memory>

#include "catch.hpp"
#include "regions/slab_depths.hpp"
#include "subdivisions/searches.hpp"
#include "trace/machine.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Slabs that end anywhere: within objects, on their faces, or where nothing is.
std::vector<double> some_depths(const Model& model, const CameraFrame& frame, Dice& dice) {
  const auto slabs = static_cast<std::uint32_t>(2 + dice.below(4));
  if (dice.one_in(3)) return even_slab_depths(model, frame, slabs);
  if (dice.one_in(2)) return balanced_slab_depths(model, frame, slabs);
  std::vector<double> depths;
  for (std::uint32_t i = 1; i < slabs; ++i) depths.push_back(0.5 + dice.on_grid(5) + 5);
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  return depths;
}

struct Nodes {
  std::uint32_t columns, rows;
  MacroGrid grid;
};

Nodes some_nodes(const Model& model, Dice& dice) {
  const auto columns = static_cast<std::uint32_t>(1 + dice.below(4));
  const auto rows = static_cast<std::uint32_t>(1 + dice.below(3));
  const auto k = static_cast<std::uint32_t>(1 + dice.below(2));
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  return {columns, rows,
          MacroGrid::regular(frame, columns * k, rows * k, some_depths(model, frame, dice))};
}

}  // namespace

TEST_CASE("macro-regions with slabs give bit for bit the picture of the whole") {
  std::uint64_t handed_over = 0, secondary = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const Harvest whole = trace_whole(model);
    Dice dice(seed);
    const auto [columns, rows, grid] = some_nodes(model, dice);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, slabs " << grid.slabs());
    const Harvest parts = Machine(model, grid, columns, rows).trace(dice);
    check_equal(whole, parts, model.settings.image);
    handed_over += parts.handed_over_viewing;
    for (std::size_t kind = 2; kind < kRayKinds; ++kind) secondary += whole.rays.created[kind];
  }
  CHECK(handed_over > 50'000);
  CHECK(secondary > 10'000);
}

TEST_CASE("nodes with slabs that know what is foreign give the picture of the whole") {
  std::uint64_t without = 0, with = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Model model = model_with_lights(seed);
    const Harvest whole = trace_whole(model);
    Dice dice(seed);
    const auto [columns, rows, grid] = some_nodes(model, dice);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, slabs " << grid.slabs());
    Machine machine(model, grid, columns, rows,
                    {.has_horizons = seed % 3 != 0, .has_bounds = seed % 3 != 1}, dice);
    const Harvest held = machine.trace(dice);
    check_equal(whole, held, model.settings.image);
    with += held.handed_over;
    without += Machine(model, grid, columns, rows).trace(dice).handed_over;
  }
  CHECK(with < without);
}

TEST_CASE("each subdivision finds the same in slabs") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const Harvest whole = trace_whole(model);
    for (const auto& [name, choice] : kAllSearches) {
      Dice dice(seed);
      const auto [columns, rows, grid] = some_nodes(model, dice);
      INFO("seed " << seed << ", " << name);
      check_equal(whole, Machine(model, grid, columns, rows, choice).trace(dice),
                  model.settings.image);
    }
  }
}
