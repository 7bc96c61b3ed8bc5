// A machine of nodes without wires: domains share out a grid's macro-regions, a slab of them each,
// and rays are handed from one to the other.
#pragma once

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "regions/own_pixels.hpp"
#include "regions/restrict.hpp"
#include "trace/step.hpp"
#include "trace/tile_plan.hpp"
#include "visibility/foreign_bounds.hpp"
#include "visibility/occluders.hpp"

namespace graycube::testing {

/// The light and credit that came back from all rays of a picture.
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
      // A tile may be whole by now: then any further return is one too many.
      REQUIRE((r.merged > 0 || !r.credit.is_zero()));
      light[r.pixel].add(r.light);
      credit[r.pixel].add(r.credit);
    }
    rays.add(step.rays);
    rounding.add(step.rounding);
  }
};

inline Harvest trace_whole(const Model& model, const SubdivisionChoice& subdivision = {}) {
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
  Machine(const Model& model, const MacroGrid& grid, const SubdivisionChoice& subdivision = {})
      : Machine(model, grid, grid.columns(), grid.rows(), subdivision) {}
  /// Columns × rows of nodes, regions scattered over them.
  Machine(const Model& model, const MacroGrid& grid, std::uint32_t columns, std::uint32_t rows,
          const SubdivisionChoice& subdivision = {},
          std::shared_ptr<const LightHorizons> horizons = nullptr)
      : image_(model.settings.image), grid_(grid), columns_(columns), rows_(rows) {
    for_each_share([&](const RegionShare& share) {
      domains_.push_back(std::make_unique<Domain>(
          grid, share, restrict_to_share(model, grid, share), subdivision));
      domains_.back()->set_horizons(horizons);
      evaluators_.emplace_back(*domains_.back());
    });
  }

  /// Which knowledge nodes have of objects that they don't hold.
  struct Knowledge {
    bool has_horizons = false, has_bounds = false;
  };
  /// The same, but nodes also hold some objects whole, as dice decide, and have `knows` of the
  /// others. If nodes have own pixels, regions aren't scattered.
  Machine(const Model& model, const MacroGrid& grid, std::uint32_t columns, std::uint32_t rows,
          Knowledge knows, Dice& dice, std::vector<std::int64_t> own_edges = {})
      : image_(model.settings.image),
        grid_(grid),
        columns_(columns),
        rows_(rows),
        own_edges_(std::move(own_edges)) {
    const Occluders occluders = Occluders::of(model);
    const SurfaceTree whole = SurfaceTree::build(model);
    const ForeignBoundsMaker maker(whole);
    for_each_share([&](const RegionShare& share) {
      ModelContents contents = contents_with_own_pixels(model, grid, share, own_edges_);
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
        domains_.back()->set_foreign_bounds(
            std::make_shared<const ForeignBounds>(*std::move(bounds)));
      }
      evaluators_.emplace_back(*domains_.back());
    });
  }

  static constexpr std::size_t kMuchRoom = std::size_t{1} << 20;
  /// The number of objects of which nodes hold a part.
  std::size_t parts = 0;

  /// Rays wait in one queue for all regions. Those of the region of a ray at either end are taken
  /// together, as many as come.
  Harvest trace(Dice& dice) {
    Harvest harvest(image_);
    const TilePlan plan(image_, {5, 3}, grid_, own_edges_);
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
    std::size_t node = 0;
    for_each_share([&](const RegionShare& share) {
      for (const std::uint32_t tile : plan.tiles_of(share)) {
        evaluators_[node].trace_pixels(plan.rect(tile), step);
        finish(node);
      }
      ++node;
    });
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
  /// Calls f(share) for each node, in the order of their numbers.
  template <class F>
  void for_each_share(F&& f) const {
    for (std::uint32_t slab = 0; slab < grid_.slabs(); ++slab) {
      for (std::uint32_t row = 0; row < rows_; ++row) {
        for (std::uint32_t column = 0; column < columns_; ++column) {
          f(RegionShare{columns_, rows_, column, row, grid_.slabs(), slab});
        }
      }
    }
  }
  std::size_t number(RegionIndex r) const {
    return (r.slab * std::size_t{rows_} + r.row % rows_) * columns_ + r.column % columns_;
  }

  ImageSize image_;
  const MacroGrid& grid_;
  std::uint32_t columns_, rows_;
  std::vector<std::int64_t> own_edges_;
  std::vector<std::unique_ptr<Domain>> domains_;
  std::deque<Evaluator> evaluators_;
};

inline void check_equal(const Harvest& whole, const Harvest& parts, const ImageSize& image) {
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

/// A random model; half of them have lights outside of all objects, which see most.
inline Model model_with_lights(std::uint64_t seed) {
  RandomOptions options;
  options.unbounded = seed % 2 == 0;
  Scene scene = RandomModel(seed, options).scene();
  if (!options.unbounded) {
    for (PointLight& light : scene.settings.lights) light.position = 4.0 * light.position;
  }
  return compile_scene(scene);
}

}  // namespace graycube::testing
