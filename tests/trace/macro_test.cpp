// Macro-regions against the whole: rays handed from domain to domain must give the same picture bit
// for bit, the same counts, and all credit back.
#include <map>
#include <memory>
#include <vector>

#include "catch.hpp"
#include "subdivisions/searches.hpp"
#include "trace/machine.hpp"
#include "trace/render_serial.hpp"
#include "visibility/light_depths.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

MacroGrid uneven_grid(const CameraFrame& frame, Dice& dice) {
  const auto edges = [&](std::int64_t pixels) {
    std::vector<std::int64_t> r;
    for (std::int64_t at = -3; at < pixels + 3;) {
      at += 1 + static_cast<std::int64_t>(dice.below(9));
      r.push_back(at);
    }
    return r;
  };
  auto columns = edges(frame.image.width);
  auto rows = edges(frame.image.height);
  return {frame, std::move(columns), std::move(rows)};
}

struct Size {
  std::uint32_t columns, rows;
};
const std::vector<Size> kSizes{{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1},
                               {1, 3}, {3, 3}, {4, 2}, {5, 4}, {8, 4}};

}  // namespace

TEST_CASE("macro-regions give bit for bit the picture of the whole") {
  std::uint64_t handed_over = 0, secondary = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const Harvest whole = trace_whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    Dice dice(seed);
    for (std::size_t i = 0; i < 4; ++i) {
      const Size size = kSizes[dice.below(kSizes.size())];
      const MacroGrid grid =
          i == 3 ? uneven_grid(frame, dice) : MacroGrid::regular(frame, size.columns, size.rows);
      INFO("seed " << seed << ", grid " << grid.columns() << " x " << grid.rows()
                   << (i == 3 ? ", uneven" : ""));
      const Harvest parts = Machine(model, grid).trace(dice);
      check_equal(whole, parts, model.settings.image);
      handed_over += parts.handed_over;
    }
    for (std::size_t kind = 1; kind < kRayKinds; ++kind) secondary += whole.rays.created[kind];
  }
  CHECK(handed_over > 20000);
  CHECK(secondary > 20000);
}

TEST_CASE(
    "scattered macro-regions give the picture of the whole, with light horizons, depths and "
    "without") {
  constexpr std::uint64_t kDepthTexels = 40'000;
  std::uint64_t skipped = 0, skipped_with_depth = 0, without = 0, with = 0, with_depth = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const Model model = model_with_lights(seed);
    const Harvest whole = trace_whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    const auto horizons = std::make_shared<const LightHorizons>(LightHorizons::of(model));
    const auto depths = std::make_shared<const LightHorizons>(
        with_depths(*horizons, SurfaceTree::build(model), kDepthTexels));
    Dice dice(seed);
    const auto columns = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto rows = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto k = static_cast<std::uint32_t>(1 + dice.below(4));
    const MacroGrid grid = MacroGrid::regular(frame, columns * k, rows * k);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, scatter " << k);
    const Harvest forward = Machine(model, grid, columns, rows).trace(dice);
    check_equal(whole, forward, model.settings.image);
    const Harvest horizon =
        Machine(model, grid, columns, rows, {Subdivision::kSurfaces}, horizons).trace(dice);
    check_equal(whole, horizon, model.settings.image);
    const Harvest deep =
        Machine(model, grid, columns, rows, {Subdivision::kSurfaces}, depths).trace(dice);
    check_equal(whole, deep, model.settings.image);
    without += forward.handed_over;
    with += horizon.handed_over;
    with_depth += deep.handed_over;
    skipped += horizon.rays.skipped_by_horizon;
    skipped_with_depth += deep.rays.skipped_by_horizon;
  }
  CHECK(skipped > 1000);
  // Compilers draw different scenes of a seed: 300 to 600 more.
  CHECK(skipped_with_depth > skipped + 100);
  CHECK(with < without);
  CHECK(with_depth < with);
}

TEST_CASE("a shadow ray is finished where it was made, with borrowed models") {
  std::uint64_t lacking = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    const MacroGrid grid = MacroGrid::regular(frame, 8, 4);
    const RegionShare share{4, 2, 1, 0};
    std::shared_ptr<const Domain> domain =
        std::make_shared<Domain>(grid, share, restrict_to_share(model, grid, share));
    // The node traces its own primary rays, and borrows one model after another.
    const TilePlan plan(model.settings.image, {5, 3}, grid);
    std::vector<RayTask> waiting;
    Step step;
    for (const std::uint32_t tile : plan.tiles_of(share)) {
      Evaluator(*domain).trace_pixels(plan.rect(tile), step);
    }
    for (const RayTask& task : step.leaving) {
      if (task.kind == RayKind::kShadow) waiting.push_back(task);
    }
    const std::size_t shadows = waiting.size();
    Harvest harvest(model.settings.image);
    for (std::uint32_t place = 0; place < 8; ++place) {
      if (place == 1) continue;
      const RegionShare other{4, 2, place % 4, place / 4};
      domain = domain->with_borrowed(other, Territory::of(restrict_to_share(model, grid, other)));
      step.clear();
      Evaluator(*domain).trace_rays(waiting, step);
      REQUIRE(step.leaving.empty());
      waiting.clear();
      for (const Step::Lacking& l : step.lacking) {
        REQUIRE_FALSE(domain->holds(l.task.region));
        waiting.push_back(l.task);
      }
      lacking += waiting.size();
      harvest.take(step);
    }
    REQUIRE(waiting.empty());
    // The same rays, in a domain without boundaries.
    const Domain whole(model);
    Harvest expected(model.settings.image);
    step.clear();
    for (const std::uint32_t tile : plan.tiles_of(share)) {
      Evaluator(Domain(grid, share, restrict_to_share(model, grid, share)))
          .trace_pixels(plan.rect(tile), step);
    }
    std::vector<RayTask> again;
    for (const RayTask& task : step.leaving) {
      if (task.kind == RayKind::kShadow) again.push_back(task);
    }
    REQUIRE(again.size() == shadows);
    step.clear();
    Evaluator(whole).trace_rays(again, step);
    expected.take(step);
    for (std::size_t pixel = 0; pixel < expected.light.size(); ++pixel) {
      REQUIRE(harvest.light[pixel] == expected.light[pixel]);
    }
  }
  CHECK(lacking > 1000);
}

TEST_CASE("every subdivision gives the same picture, of the whole and of macro-regions") {
  for (std::uint64_t seed = 1000; seed < 1040; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const Harvest whole = trace_whole(model);
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    for (const NamedChoice& way : kAllSearches) {
      INFO("seed " << seed << ", " << way.name);
      check_equal(whole, trace_whole(model, way.choice), model.settings.image);
      Dice dice(seed);
      check_equal(whole, Machine(model, grid, way.choice).trace(dice), model.settings.image);
    }
  }
}

TEST_CASE("a grid of each size renders one scene alike") {
  const Model model = compile_scene(RandomModel(12, {.max_objects = 12}).scene());
  const Harvest whole = trace_whole(model);
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  Dice dice(1);
  for (std::uint32_t columns = 1; columns <= 8; ++columns) {
    for (std::uint32_t rows = 1; rows <= 4; ++rows) {
      INFO("grid " << columns << " x " << rows);
      const MacroGrid grid = MacroGrid::regular(frame, columns, rows);
      check_equal(whole, Machine(model, grid).trace(dice), model.settings.image);
    }
  }
}

TEST_CASE("more columns and rows than pixels render the same picture") {
  for (std::uint64_t seed = 500; seed < 506; ++seed) {
    Scene scene = RandomModel(seed).scene();
    scene.settings.image = {6, 5, 1};
    const Model model = compile_scene(scene);
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(scene.settings.camera, scene.settings.image), 16, 8);
    INFO("seed " << seed);
    Dice dice(seed);
    check_equal(trace_whole(model), Machine(model, grid).trace(dice), scene.settings.image);
  }
}

TEST_CASE("the serial picture is the same for any number of threads, and that of the pure step") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    Scene scene = RandomModel(seed).scene();
    scene.settings.image = {70, 40, scene.settings.image.samples};
    const Model model = compile_scene(scene);
    const Harvest harvest = trace_whole(model);
    const std::uint32_t samples = scene.settings.image.samples;
    Film expected(70, 40, samples * samples);
    for (std::uint32_t pixel = 0; pixel < harvest.light.size(); ++pixel)
      expected.add(pixel, harvest.light[pixel]);
    const Domain domain{Model(model)};
    for (const unsigned threads : {1u, 3u}) {
      Film film(70, 40, samples * samples);
      const SerialResult result = render_serial(domain, {.threads = threads, .progress = {}}, film);
      REQUIRE(result.finished);
      REQUIRE(film.develop() == expected.develop());
      REQUIRE(result.rays.created == harvest.rays.created);
    }
  }
}

TEST_CASE("what stands between a boundary and a light close behind it is not forgotten") {
  // Each light has a ball before it that lies wholly in the light's region.
  Dice dice(8);
  Scene scene = scene_of({node_of(HalfSpaceShape{{0, 0, -1}, -4})});
  scene.materials.push_back({"glass", {}});
  scene.materials[1].material.transmit = 0.5;
  scene.settings.image = {16, 16, 1};
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 60;
  for (int i = 0; i < 12; ++i) {
    Vec3 p = dice.point(3);
    p[i % 2] = dice.sign() * 0.006;  // the middle boundaries are x = 0 and y = 0
    scene.settings.lights.push_back({p, {1, 1, 1}, Falloff::kNone});
    scene.objects.push_back(
        {"", static_cast<MaterialIndex>(dice.below(2)), node_of(SphereShape{p, 0.004})});
  }
  const Model model = compile_scene(scene);
  const MacroGrid grid =
      MacroGrid::regular(CameraFrame::from(scene.settings.camera, scene.settings.image), 2, 2);
  check_equal(trace_whole(model), Machine(model, grid).trace(dice), scene.settings.image);
}

TEST_CASE("a cancelled serial render says so") {
  const Domain domain(compile_scene(RandomModel(1).scene()));
  const ImageSize& image = domain.settings().image;
  Film film(image.width, image.height, image.samples * image.samples);
  CHECK_FALSE(render_serial(domain, {.threads = 1, .progress = [](double) { return false; }}, film)
                  .finished);
}

TEST_CASE("credit comes back whole from the deepest trees and from many lights") {
  // A hall of glass and mirrors, with as many lights as credit allows.
  Scene scene = scene_of({});
  Material m;
  m.transmit = 0.6;
  m.reflect = 0.4;
  m.ior = 1.3;
  scene.materials = {{"glass", m}};
  for (int i = 0; i < 3; ++i) {
    scene.objects.push_back({"", 0, node_of(SphereShape{{0.1 * i, 0, 3.0 * i}, 1})});
  }
  scene.settings.max_depth = 9;
  scene.settings.image = {2, 2, 2};
  for (std::uint32_t i = 0; i < kMaxCreditLights; ++i) {
    scene.settings.lights.push_back({{0.5 * i - 16, 9, -4}, {0.01, 0.01, 0.01}, Falloff::kNone});
  }
  const Model model = compile_scene(scene);
  const Harvest whole = trace_whole(model);
  CHECK(whole.rays.created[static_cast<std::size_t>(RayKind::kShadow)] > 10000);
  const MacroGrid grid =
      MacroGrid::regular(CameraFrame::from(scene.settings.camera, scene.settings.image), 2, 2);
  Dice dice(3);
  check_equal(whole, Machine(model, grid).trace(dice), scene.settings.image);
}

TEST_CASE("credit comes back whole from a chain as deep as credit allows") {
  Scene scene =
      scene_of({node_of(HalfSpaceShape{{0, 0, -1}, -1}), node_of(HalfSpaceShape{{0, 0, 1}, -1})});
  scene.materials[0].material.reflect = 1;
  scene.settings.camera.eye = {0, 0, 0};
  scene.settings.camera.look_at = {0, 0, 1};
  scene.settings.max_depth = kMaxCreditDepth;
  for (std::uint32_t i = 0; i < kMaxCreditLights; ++i)
    scene.settings.lights.push_back({{0.1 * i, 0, 0}, {}, {}});
  const Model model = compile_scene(scene);
  const Harvest whole = trace_whole(model);
  CHECK(whole.rays.created[static_cast<std::size_t>(RayKind::kReflection)] == kMaxCreditDepth);
  CHECK(whole.credit[0].is_exactly(1));
}
