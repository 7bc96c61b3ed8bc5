// Nodes that know where foreign objects are finish rays wherever these go: the picture is that of
// the whole.
#include <memory>

#include "catch.hpp"
#include "trace/machine.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

RandomOptions bounded() {
  RandomOptions options;
  options.unbounded = false;
  return options;
}

/// Columns × rows of nodes, and macro-regions scattered over them.
struct Nodes {
  std::uint32_t columns, rows;
  MacroGrid grid;
};

Nodes some_nodes(const Model& model, Dice& dice) {
  const auto columns = static_cast<std::uint32_t>(1 + dice.below(4));
  const auto rows = static_cast<std::uint32_t>(1 + dice.below(4));
  const auto k = static_cast<std::uint32_t>(1 + dice.below(3));
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  return {columns, rows, MacroGrid::regular(frame, columns * k, rows * k)};
}

/// Counts the rays that leave a node's macro-regions when it traces its own primary rays.
std::size_t leaving(const Domain& domain, const MacroGrid& grid, const RegionShare& share) {
  Step step;
  Evaluator evaluator(domain);
  const TilePlan plan(domain.settings().image, {5, 3}, grid);
  for (const std::uint32_t tile : plan.tiles_of(share))
    evaluator.trace_pixels(plan.rect(tile), step);
  return step.leaving.size();
}

}  // namespace

TEST_CASE("nodes that hold some occluders give the picture of the whole, and hand over less") {
  std::uint64_t without = 0, with = 0, parts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Model model = model_with_lights(seed);
    const Harvest whole = trace_whole(model);
    Dice dice(seed);
    const auto [columns, rows, grid] = some_nodes(model, dice);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, " << grid.columns()
                 << " x " << grid.rows() << " regions");
    Machine machine(model, grid, columns, rows, {.has_horizons = true}, dice);
    const Harvest held = machine.trace(dice);
    check_equal(whole, held, model.settings.image);
    with += held.handed_over;
    parts += machine.parts;
    without += Machine(model, grid, columns, rows).trace(dice).handed_over;
  }
  CHECK(10 * with < 9 * without);
  CHECK(parts > 200);
}

TEST_CASE(
    "nodes that know where foreign objects may be give the picture of the whole, and hand over few "
    "viewing rays") {
  std::uint64_t without = 0, with = 0, shadow_without = 0, shadow_with = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    // Without bounds, nothing would be known of all other objects.
    Scene scene = RandomModel(seed, bounded()).scene();
    if (seed % 3 == 0) {
      for (PointLight& light : scene.settings.lights) light.position = 4.0 * light.position;
    }
    // More generations: a ray that has left its macro-region sends its children out there.
    scene.settings.max_depth = 4;
    const Model model = compile_scene(scene);
    const Harvest whole = trace_whole(model);
    Dice dice(seed);
    const auto [columns, rows, grid] = some_nodes(model, dice);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, " << grid.columns()
                 << " x " << grid.rows() << " regions");
    Dice same = dice;
    const Harvest blind = Machine(model, grid, columns, rows, {}, same).trace(dice);
    check_equal(whole, blind, model.settings.image);
    Machine knowing(model, grid, columns, rows,
                    {.has_horizons = dice.one_in(2), .has_bounds = true}, dice);
    const Harvest seen = knowing.trace(dice);
    check_equal(whole, seen, model.settings.image);
    without += blind.handed_over_viewing;
    with += seen.handed_over_viewing;
    shadow_without += blind.handed_over - blind.handed_over_viewing;
    shadow_with += seen.handed_over - seen.handed_over_viewing;
  }
  CHECK(without > 10'000);
  CHECK(10 * with < 9 * without);
  CHECK(shadow_with < shadow_without);
}

TEST_CASE("nodes whose own pixels are others than their regions' give the picture of the whole") {
  std::uint64_t strips = 0, handed_over = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Scene scene = RandomModel(seed, bounded()).scene();
    scene.settings.max_depth = 4;
    const Model model = compile_scene(scene);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    if (Domain(model).primary_rays_may_leave()) continue;
    Dice dice(seed);
    const auto columns = static_cast<std::uint32_t>(2 + dice.below(3)),
               rows = static_cast<std::uint32_t>(1 + dice.below(4));
    const MacroGrid grid = MacroGrid::regular(frame, columns, rows);
    std::vector<std::int64_t> own;
    for (std::uint32_t row = 0; row < rows; ++row) {
      std::int64_t edge = 0;
      for (std::uint32_t left = columns - 1; left > 0; --left) {
        edge += 1 + static_cast<std::int64_t>(dice.below(
                        (frame.image.width - static_cast<std::size_t>(edge)) / (left + 1)));
        own.push_back(edge);
      }
    }
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes");
    // If nodes don't know what is foreign, rays that begin beside their regions leave at once.
    Machine machine(model, grid, columns, rows,
                    {.has_horizons = dice.one_in(2), .has_bounds = !dice.one_in(4)}, dice, own);
    const Harvest parts = machine.trace(dice);
    check_equal(trace_whole(model), parts, model.settings.image);
    handed_over += parts.handed_over;
    strips += own.size();
  }
  CHECK(strips > 500);
  CHECK(handed_over > 10'000);
}

TEST_CASE(
    "a node that holds all objects finishes all rays, however it knows that nothing is foreign") {
  std::uint64_t handed_over = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    INFO("seed " << seed);
    const bool by_bounds = seed % 2 == 0;
    Scene scene = RandomModel(seed).scene();
    // Foreign horizons finish shadow rays only.
    scene.settings.max_depth = by_bounds ? 4 : 0;
    const Model model = compile_scene(scene);
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    const RegionShare share{4, 2, 1, 1};
    const ModelContents all{std::vector<bool>(model.objects.size(), true), {}};
    REQUIRE(extract(model, all) == model);
    Domain domain(grid, share, model);
    if (by_bounds) {
      const SurfaceTree whole = SurfaceTree::build(model);
      domain.set_foreign_bounds(
          std::make_shared<const ForeignBounds>(*ForeignBoundsMaker(whole).bounds(all, 1 << 20)));
    } else {
      domain.set_foreign_horizons(
          std::make_shared<const LightHorizons>(Occluders::of(model).foreign_horizons(all, model)));
    }
    REQUIRE(leaving(domain, grid, share) == 0);
    handed_over += leaving(Domain(grid, share, model), grid, share);
  }
  CHECK(handed_over > 1000);
}
