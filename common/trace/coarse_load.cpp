#include "trace/coarse_load.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trace/step.hpp"

namespace graycube {
namespace {

/// All regions of the grid, seen one at a time: what leaves one goes on in the next.
class CoarseTrace {
 public:
  CoarseTrace(const Domain& whole, const MacroGrid& grid,
              std::shared_ptr<const LightHorizons> horizons, double crossing_cost)
      : grid_(grid), crossing_cost_(crossing_cost), map_(grid.columns(), grid.rows()) {
    for (std::uint32_t row = 0; row < grid.rows(); ++row) {
      for (std::uint32_t column = 0; column < grid.columns(); ++column) {
        regions_.push_back(std::make_unique<Domain>(
            whole.restricted_to(grid, {grid.columns(), grid.rows(), column, row})));
        regions_.back()->set_horizons(horizons);
      }
    }
  }

  void trace_pixel(std::uint32_t x, std::uint32_t y) {
    const RegionIndex at = grid_.region_of_pixel(x, y);
    Evaluator evaluator(domain(at));
    evaluator.trace_pixels({x, y, x + 1, y + 1}, step_);
    take(at, evaluator.walk_counts());
    while (!waiting_.empty()) {
      const RayTask task = waiting_.back();
      waiting_.pop_back();
      map_.at(task.region.column, task.region.row) += crossing_cost_;
      Evaluator next(domain(task.region));
      next.trace_rays({&task, 1}, step_);
      take(task.region, next.walk_counts());
    }
  }

  const LoadMap& map() const { return map_; }

 private:
  const Domain& domain(RegionIndex r) const {
    return *regions_[std::size_t{r.row} * grid_.columns() + r.column];
  }
  void take(RegionIndex at, const WalkCounts& walk) {
    const auto& created = step_.rays.created;
    map_.at(at.column, at.row) +=
        static_cast<double>(std::accumulate(created.begin(), created.end(), std::uint64_t{0}) +
                            walk.primitives_tested);
    waiting_.insert(waiting_.end(), step_.leaving.begin(), step_.leaving.end());
    step_.clear();
  }

  const MacroGrid& grid_;
  double crossing_cost_;
  LoadMap map_;
  std::vector<std::unique_ptr<Domain>> regions_;
  Step step_;
  std::vector<RayTask> waiting_;
};

}  // namespace

LoadMap coarse_load(const Domain& whole, const MacroGrid& grid,
                    std::shared_ptr<const LightHorizons> horizons, double crossing_cost) {
  CoarseTrace trace(whole, grid, std::move(horizons), crossing_cost);
  const ImageSize& image = whole.settings().image;
  const double pixels = static_cast<double>(image.width) * image.height;
  const double wanted =
      std::clamp(kCoarseShare * pixels, static_cast<double>(kLeastCoarsePixels),
                 static_cast<double>(kMostCoarsePixels));
  const auto step = std::max(1u, static_cast<std::uint32_t>(std::sqrt(pixels / wanted)));
  for (std::uint32_t y = step / 2; y < image.height; y += step) {
    for (std::uint32_t x = step / 2; x < image.width; x += step) trace.trace_pixel(x, y);
  }
  return trace.map();
}

}  // namespace graycube
