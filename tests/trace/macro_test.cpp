// Macro-regions against the whole: rays handed from domain to domain must give the same picture bit
// for bit, the same counts, and all credit back.
#include <catch2/catch.hpp>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "csg/random_model.hpp"
#include "space/foreign_bounds.hpp"
#include "space/light_depths.hpp"
#include "space/occluders.hpp"
#include "space/restrict.hpp"
#include "trace/render_serial.hpp"
#include "trace/tile_plan.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// What came back from all rays of a picture.
struct Harvest {
  std::vector<FixedRgb> light;
  std::vector<Credit> credit;
  RayCounts rays;
  RoundingCounts rounding;
  std::uint64_t handed_over = 0, handed_over_viewing = 0;

  explicit Harvest(const ImageSize& image)
      : light(std::size_t{image.width} * image.height), credit(light.size()) {}

  void take(const Step& step) {
    for (const PixelReturn& r : step.returns) {
      REQUIRE(r.merged <= kMaxMergedContributions);
      // A tile may be whole by now: for it any return is one too many.
      REQUIRE((r.merged > 0 || !r.credit.is_zero()));
      light[r.pixel].add(r.light);
      credit[r.pixel].add(r.credit);
    }
    rays.add(step.rays);
    rounding.add(step.rounding);
  }
};

Harvest trace_whole(const Model& model, Subdivision subdivision = Subdivision::kSurfaceTree) {
  const ImageSize& image = model.settings.image;
  Harvest harvest(image);
  const Domain domain(model, subdivision);
  Evaluator evaluator(domain);
  Step step;
  evaluator.trace_pixels({0, 0, image.width, image.height}, step);
  REQUIRE(step.leaving.empty());
  harvest.take(step);
  return harvest;
}

/// Nodes that share out the regions of a grid, each with its own restricted model and evaluator.
class Machine {
 public:
  /// A node for each region.
  Machine(const Model& model, const MacroGrid& grid,
          Subdivision subdivision = Subdivision::kSurfaceTree)
      : Machine(model, grid, grid.columns(), grid.rows(), subdivision) {}
  /// Columns × rows of nodes, regions scattered over them.
  Machine(const Model& model, const MacroGrid& grid, std::uint32_t columns, std::uint32_t rows,
          Subdivision subdivision = Subdivision::kSurfaceTree,
          std::shared_ptr<const LightHorizons> horizons = nullptr)
      : image_(model.settings.image), grid_(grid), columns_(columns), rows_(rows) {
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const RegionShare share{columns, rows, column, row};
        domains_.push_back(std::make_unique<Domain>(
            grid, share, restrict_to_share(model, grid, share), subdivision));
        domains_.back()->set_horizons(horizons);
        evaluators_.emplace_back(*domains_.back());
      }
    }
  }

  /// How nodes know of what they don't hold.
  struct Knowledge {
    bool has_horizons = false, has_bounds = false;
  };
  /// The same, where nodes also hold whole what dice say of the objects, and know what they don't hold.
  Machine(const Model& model, const MacroGrid& grid, std::uint32_t columns, std::uint32_t rows, Knowledge knows, Dice& dice)
      : image_(model.settings.image), grid_(grid), columns_(columns), rows_(rows) {
    const Occluders occluders = Occluders::of(model);
    const SurfaceTree whole = SurfaceTree::build(model);
    const ForeignBoundsMaker maker(whole);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) {
        const RegionShare share{columns, rows, column, row};
        ModelContents contents = contents_of_share(model, grid, share);
        const std::uint64_t one_in = 1 + dice.below(4);
        std::vector<bool> chosen(model.objects.size());
        for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = dice.one_in(one_in);
        contents.hold_whole(chosen);
        parts += contents.parts.size();
        const Model slice = extract(model, contents);
        domains_.push_back(std::make_unique<Domain>(grid, share, slice));
        if (knows.has_horizons) {
          domains_.back()->set_foreign_horizons(
              std::make_shared<const LightHorizons>(occluders.foreign_horizons(contents, model)));
        }
        auto bounds = maker.bounds(contents, dice.one_in(2) ? kMuchRoom : dice.below(4000));
        if (knows.has_bounds && bounds) {
          domains_.back()->set_foreign_bounds(std::make_shared<const ForeignBounds>(*std::move(bounds)));
        }
        evaluators_.emplace_back(*domains_.back());
      }
    }
  }

  static constexpr std::size_t kMuchRoom = std::size_t{1} << 20;
  /// Objects of which nodes hold a part.
  std::size_t parts = 0;

  /// Rays wait in one queue for all regions. Those of the region of a ray at either end are taken together,
  /// as many as come.
  Harvest trace(Dice& dice) {
    Harvest harvest(image_);
    const TilePlan plan(image_, {5, 3}, grid_);
    std::deque<RayTask> waiting;
    Step step;
    const auto finish = [&](std::size_t at) {
      harvest.take(step);
      for (const RayTask& task : step.leaving) {
        REQUIRE(number(task.region) != at);
        waiting.push_back(task);
        if (task.kind != RayKind::kShadow) ++harvest.handed_over_viewing;
      }
      harvest.handed_over += step.leaving.size();
      step.clear();
    };
    for (std::uint32_t row = 0; row < rows_; ++row) {
      for (std::uint32_t column = 0; column < columns_; ++column) {
        for (const std::uint32_t tile : plan.tiles_of({columns_, rows_, column, row})) {
          evaluators_[row * columns_ + column].trace_pixels(plan.rect(tile), step);
          finish(row * columns_ + column);
        }
      }
    }
    while (!waiting.empty()) {
      const bool front = dice.one_in(2);
      const std::size_t at = number((front ? waiting.front() : waiting.back()).region);
      const std::size_t most = dice.one_in(2) ? 1 : 1 + dice.below(300);
      std::vector<RayTask> batch;
      std::deque<RayTask> others;
      for (const RayTask& task : waiting) {
        const bool taken = batch.size() < most && number(task.region) == at;
        (taken ? static_cast<void>(batch.push_back(task)) : others.push_back(task));
      }
      waiting.swap(others);
      evaluators_[at].trace_rays(batch, step);
      finish(at);
    }
    return harvest;
  }

 private:
  std::size_t number(RegionIndex r) const { return r.row % rows_ * columns_ + r.column % columns_; }

  ImageSize image_;
  const MacroGrid& grid_;
  std::uint32_t columns_, rows_;
  std::vector<std::unique_ptr<Domain>> domains_;
  std::deque<Evaluator> evaluators_;
};

void check_equal(const Harvest& whole, const Harvest& parts, const ImageSize& image) {
  const std::uint64_t primary = std::uint64_t{image.samples} * image.samples;
  for (std::size_t pixel = 0; pixel < whole.light.size(); ++pixel) {
    INFO("pixel " << pixel % image.width << ", " << pixel / image.width);
    REQUIRE(parts.light[pixel] == whole.light[pixel]);
    REQUIRE(whole.credit[pixel].is_exactly(primary));
    REQUIRE(parts.credit[pixel].is_exactly(primary));
  }
  CHECK(parts.rays.created == whole.rays.created);
  CHECK(parts.rounding.clamped == whole.rounding.clamped);
  CHECK(parts.rounding.non_finite == whole.rounding.non_finite);
}

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

RandomOptions bounded() {
  RandomOptions options;
  options.unbounded = false;
  return options;
}

/// Half of them have lights outside of everything, which see most.
Model model_with_lights(std::uint64_t seed) {
  RandomOptions options;
  options.unbounded = seed % 2 == 0;
  Scene scene = RandomModel(seed, options).scene();
  if (!options.unbounded) {
    for (PointLight& light : scene.settings.lights) light.position = 4.0 * light.position;
  }
  return compile_scene(scene);
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

TEST_CASE("scattered macro-regions give the picture of the whole, with light horizons, depths and without") {
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
        Machine(model, grid, columns, rows, Subdivision::kSurfaceTree, horizons).trace(dice);
    check_equal(whole, horizon, model.settings.image);
    const Harvest deep = Machine(model, grid, columns, rows, Subdivision::kSurfaceTree, depths).trace(dice);
    check_equal(whole, deep, model.settings.image);
    without += forward.handed_over;
    with += horizon.handed_over;
    with_depth += deep.handed_over;
    skipped += horizon.rays.skipped_by_horizon;
    skipped_with_depth += deep.rays.skipped_by_horizon;
  }
  CHECK(skipped > 1000);
  CHECK(skipped_with_depth > skipped + 500);
  CHECK(with < without);
  CHECK(with_depth < with);
}

TEST_CASE("nodes that hold some occluders give the picture of the whole, and hand over less") {
  std::uint64_t without = 0, with = 0, parts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Model model = model_with_lights(seed);
    const Harvest whole = trace_whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    Dice dice(seed);
    const auto columns = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto rows = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto k = static_cast<std::uint32_t>(1 + dice.below(3));
    const MacroGrid grid = MacroGrid::regular(frame, columns * k, rows * k);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, scatter " << k);
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

TEST_CASE("nodes that know where foreign objects may be give the picture of the whole, and hand over few viewing rays") {
  std::uint64_t without = 0, with = 0, shadow_without = 0, shadow_with = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    // Without bounds nothing would be known of all others.
    Scene scene = RandomModel(seed, bounded()).scene();
    if (seed % 3 == 0) {
      for (PointLight& light : scene.settings.lights) light.position = 4.0 * light.position;
    }
    // More generations: what a ray sends out that has left its macro-region begins there.
    scene.settings.max_depth = 4;
    const Model model = compile_scene(scene);
    const Harvest whole = trace_whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    Dice dice(seed);
    const auto columns = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto rows = static_cast<std::uint32_t>(1 + dice.below(4));
    const auto k = static_cast<std::uint32_t>(1 + dice.below(3));
    const MacroGrid grid = MacroGrid::regular(frame, columns * k, rows * k);
    INFO("seed " << seed << ", " << columns << " x " << rows << " nodes, scatter " << k);
    Dice same = dice;
    const Harvest blind = Machine(model, grid, columns, rows, {}, same).trace(dice);
    check_equal(whole, blind, model.settings.image);
    Machine knowing(model, grid, columns, rows, {.has_horizons = dice.one_in(2), .has_bounds = true}, dice);
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

TEST_CASE("a node that holds all objects finishes all rays, and needs no region for what they send out") {
  std::uint64_t handed_over = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Scene scene = RandomModel(seed).scene();
    scene.settings.max_depth = 4;
    const Model model = compile_scene(scene);
    const MacroGrid grid = MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    const RegionShare share{4, 2, 1, 1};
    ModelContents contents = contents_of_share(model, grid, share);
    contents.hold_whole(std::vector<bool>(model.objects.size(), true));
    Domain domain(grid, share, model);
    const SurfaceTree whole = SurfaceTree::build(model);
    domain.set_foreign_bounds(std::make_shared<const ForeignBounds>(*ForeignBoundsMaker(whole).bounds(contents, 1 << 20)));
    const Domain without(grid, share, model);
    const TilePlan plan(model.settings.image, {5, 3}, grid);
    Step step;
    for (const std::uint32_t tile : plan.tiles_of(share)) Evaluator(domain).trace_pixels(plan.rect(tile), step);
    REQUIRE(step.leaving.empty());
    step.clear();
    for (const std::uint32_t tile : plan.tiles_of(share)) Evaluator(without).trace_pixels(plan.rect(tile), step);
    handed_over += step.leaving.size();
  }
  CHECK(handed_over > 500);
}

TEST_CASE("a node that holds all objects finishes all shadow rays") {
  std::uint64_t handed_over = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Scene scene = RandomModel(seed).scene();
    scene.settings.max_depth = 0;
    const Model model = compile_scene(scene);
    const MacroGrid grid = MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    const RegionShare share{4, 2, 1, 1};
    ModelContents contents = contents_of_share(model, grid, share);
    contents.hold_whole(std::vector<bool>(model.objects.size(), true));
    const Model slice = extract(model, contents);
    REQUIRE(slice == model);
    Domain domain(grid, share, slice);
    domain.set_foreign_horizons(
        std::make_shared<const LightHorizons>(Occluders::of(model).foreign_horizons(contents, model)));
    Step step;
    const TilePlan plan(model.settings.image, {5, 3}, grid);
    for (const std::uint32_t tile : plan.tiles_of(share)) Evaluator(domain).trace_pixels(plan.rect(tile), step);
    REQUIRE(step.leaving.empty());
    step.clear();
    const Domain without(grid, share, slice);
    for (const std::uint32_t tile : plan.tiles_of(share)) Evaluator(without).trace_pixels(plan.rect(tile), step);
    handed_over += step.leaving.size();
  }
  CHECK(handed_over > 500);
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
    // What the node makes of its own primary rays, when it borrows one model after another.
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
      domain = domain->with_borrowed(other.column, other.row,
                                     Territory::of(restrict_to_share(model, grid, other)));
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

TEST_CASE("both subdivisions give the same picture, of the whole and of macro-regions") {
  for (std::uint64_t seed = 1000; seed < 1080; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const Harvest whole = trace_whole(model);
    check_equal(whole, trace_whole(model, Subdivision::kLinkedCells), model.settings.image);
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
    Dice dice(seed);
    check_equal(whole, Machine(model, grid, Subdivision::kLinkedCells).trace(dice),
                model.settings.image);
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
