#include "trace/coarse_load.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/infinity.hpp"
#include "trace/step.hpp"
#include "trace/work_cost.hpp"

namespace graycube {
namespace {

/// Rays wait until there are this many: they are traced region by region, and few at a time cost
/// more. The rays that descend from the last pixel may exceed this number.
constexpr std::size_t kManyRays = 32768;
/// Once this many pixels have shown that all of them will make less than this share of the
/// crossings allowed, the rest is traced in one go.
constexpr std::uint32_t kTellingPixels = 128;
constexpr double kSmallPart = 0.25;
/// When all rays stay, this many cells along each side are traced together (more when there would
/// be too many regions): larger regions fill packets better.
constexpr std::uint32_t kCellsTogether = 2;
constexpr std::uint32_t kMostRegions = 32;

/// The grid whose regions are traced one at a time: that of the cells, or, when all rays stay, a
/// coarser one, since each pixel then tells which cell its work belongs to.
MacroGrid regions_of(const CameraFrame& frame, const MacroGrid& cells, Staying staying) {
  if (!staying.all()) return cells;
  const auto together = [](std::uint32_t side) {
    return std::clamp(side / kCellsTogether, 1u, kMostRegions);
  };
  return MacroGrid::regular(frame, together(cells.columns()), together(cells.rows()));
}

/// Traces all regions of a grid, one at a time: a ray that leaves one waits for its next region.
class CoarseTrace {
 public:
  CoarseTrace(const Domain& whole, const MacroGrid& cells,
              std::shared_ptr<const LightHorizons> horizons, Staying staying, double crossing_cost)
      : cells_(cells),
        grid_(regions_of(whole.frame(), cells, staying)),
        stays_(staying),
        crossing_cost_(crossing_cost),
        map_(cells.columns(), cells.rows()),
        domain_(whole.restricted_to(grid_, {grid_.columns(), grid_.rows(), 0, 0})),
        evaluator_(domain_),
        open_domain_(whole),
        open_evaluator_(open_domain_),
        waiting_(std::size_t{grid_.columns()} * grid_.rows()),
        staying_(waiting_.size()) {
    domain_.set_horizons(horizons);
    open_domain_.set_horizons(std::move(horizons));
  }

  /// Adds a pixel's primary rays to those that wait: the rays of a region are traced together.
  void add_pixel(std::uint32_t x, std::uint32_t y) {
    const CameraFrame& frame = domain_.frame();
    const std::uint32_t samples = frame.image.samples, rays = samples * samples;
    const RegionIndex at = grid_.region_of_pixel(x, y);
    for (std::uint32_t s = 0; s < rays; ++s) {
      RayTask& ray = waiting_[index_of(at)].emplace_back();
      ray.ray = frame.primary_ray(x, y, s % samples, s / samples);
      ray.t_max = kInf;
      ray.weight = {1, 1, 1};
      ray.pixel = y * frame.image.width + x;
      ray.region = at;
    }
    waiting_count_ += rays;
    created_[static_cast<std::size_t>(RayKind::kPrimary)] += rays;
  }

  /// Traces waiting rays region by region, to and fro over the grid, until none is left: rays that
  /// go the same way gather in each region on it.
  void finish() {
    const std::size_t last = waiting_.size() - 1;
    for (bool forth = true; waiting_count_ > 0; forth = !forth) {
      for (std::size_t i = 0; i <= last; ++i) {
        const std::size_t at = forth ? i : last - i;
        trace_waiting(waiting_[at]);
        trace_staying(staying_[at]);
      }
    }
  }
  bool has_many_waiting() const { return waiting_count_ >= kManyRays; }

  /// Crossings from region to region made so far by rays that no longer wait.
  std::uint64_t crossings() const { return crossings_; }
  const LoadMap& map() const { return map_; }
  std::vector<LeavingLight> take_left_by_light() { return std::move(left_by_light_); }
  double rays_per_primary() const {
    const auto all = std::accumulate(created_.begin(), created_.end(), std::uint64_t{0});
    const std::uint64_t primary = created_[static_cast<std::size_t>(RayKind::kPrimary)];
    return primary > 0 ? static_cast<double>(all) / static_cast<double>(primary) : 0;
  }

 private:
  void trace_waiting(std::vector<RayTask>& rays) {
    if (rays.empty()) return;
    taken_.swap(rays);
    const RegionIndex at = taken_.front().region;
    waiting_count_ -= taken_.size();
    const auto began =
        static_cast<std::size_t>(std::count_if(taken_.begin(), taken_.end(), [](const RayTask& r) {
          return r.kind == RayKind::kPrimary;
        }));
    const std::size_t came = taken_.size() - began;
    crossings_ += came;
    const double beside =
        crossing_cost_ * static_cast<double>(came) +
        kCreatedCost[static_cast<std::size_t>(RayKind::kPrimary)] * static_cast<double>(began);
    trace(at, evaluator_, beside, [&] { evaluator_.trace_rays(taken_, step_); });
    taken_.clear();
  }
  /// Traces the rest of the way of rays that left a region but count as its work. The rays that
  /// they create count as crossings, so that the limit on crossings ends this work, too.
  void trace_staying(std::vector<RayTask>& rays) {
    if (rays.empty()) return;
    crossings_ += rays.size();
    waiting_count_ -= rays.size();
    const auto created = [&] {
      return std::accumulate(created_.begin(), created_.end(), std::uint64_t{0});
    };
    const std::uint64_t before = created();
    trace(rays.front().region, open_evaluator_, 0,
          [&] { open_evaluator_.trace_rays(rays, step_); });
    crossings_ += created() - before;
    rays.clear();
  }
  std::size_t index_of(RegionIndex r) const {
    return std::size_t{r.row} * grid_.columns() + r.column;
  }

  /// `beside` is the cost that the created rays and walk counts of the step don't include.
  template <typename Trace>
  void trace(RegionIndex at, const Evaluator& evaluator, double beside, Trace&& work) {
    domain_.confine_to({grid_.columns(), grid_.rows(), at.column, at.row});
    const WalkCounts before = evaluator.walk_counts();
    work();
    const WalkCounts walk = evaluator.walk_counts().since(before);
    const auto& created = step_.rays.created;
    for (std::size_t k = 0; k < created.size(); ++k) created_[k] += created[k];
    add_cost(at, beside + work_cost(created, walk, domain_.subdivision().way));
    for (RayTask& ray : step_.leaving) take_leaving(ray, at);
    waiting_count_ += step_.leaving.size();
    step_.clear();
  }

  RegionIndex cell_of(std::uint32_t pixel) const {
    const std::uint32_t width = domain_.frame().image.width;
    return cells_.region_of_pixel(pixel % width, pixel / width);
  }

  /// Spreads a step's cost over its pixels' cells by contributions, or gives it to its region.
  void add_cost(RegionIndex at, double cost) {
    if (!stays_.all()) {
      map_.at(at.column, at.row) += cost;
      return;
    }
    const ImageSize& image = domain_.frame().image;
    const auto weight = [&](const PixelReturn& r) {
      return r.pixel < std::uint64_t{image.width} * image.height ? 1.0 + r.merged : 0.0;
    };
    double all = 0;
    for (const PixelReturn& r : step_.returns) all += weight(r);
    for (const PixelReturn& r : step_.returns) {
      if (weight(r) == 0) continue;
      const RegionIndex cell = cell_of(r.pixel);
      map_.at(cell.column, cell.row) += cost * weight(r) / all;
    }
  }

  /// Queues a ray that left region `from`. Shadow rays in their first region have made no hops.
  void take_leaving(RayTask& ray, RegionIndex from) {
    const bool is_shadow = ray.kind == RayKind::kShadow;
    if (is_shadow && ray.hops == 0) {
      ray.hops = 1;
      left_by_light_.push_back({ray, stays_.all() ? cell_of(ray.pixel) : from});
    }
    if (is_shadow ? stays_.shadow_rays : stays_.secondary_rays) {
      ray.region = from;
      return staying_[index_of(from)].push_back(ray);
    }
    waiting_[index_of(ray.region)].push_back(ray);
  }

  const MacroGrid& cells_;
  /// The grid of the regions that are traced one at a time.
  MacroGrid grid_;
  Staying stays_;
  double crossing_cost_;
  LoadMap map_;
  /// The whole scene, confined to the region that is being traced.
  Domain domain_;
  Evaluator evaluator_;
  /// The whole scene without boundaries, for rays that stay.
  Domain open_domain_;
  Evaluator open_evaluator_;
  /// Rays to be traced, indexed by region of `grid_`, row by row.
  std::vector<std::vector<RayTask>> waiting_, staying_;
  std::size_t waiting_count_ = 0;
  std::vector<LeavingLight> left_by_light_;
  std::vector<RayTask> taken_;
  std::uint64_t crossings_ = 0;
  std::array<std::uint64_t, kRayKinds> created_{};  // by kind
  Step step_;
};

/// A stride (modulo `count`) that visits each of `count` places once, with those visited so far
/// always spread evenly: near the golden section of the count, and coprime with it.
std::uint32_t spreading_step(std::uint32_t count) {
  auto step = static_cast<std::uint32_t>(0.618034 * count) + 1;
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

}  // namespace

CoarseLoad coarse_load(const Domain& whole, const MacroGrid& cells,
                       std::shared_ptr<const LightHorizons> horizons, Staying staying,
                       double crossing_cost, std::uint64_t most_pixels) {
  CoarseTrace trace(whole, cells, std::move(horizons), staying, crossing_cost);
  const ImageSize& image = whole.settings().image;
  const double pixels = static_cast<double>(image.width) * image.height;
  const double wanted = std::clamp(
      kCoarseShare * pixels, static_cast<double>(kLeastCoarsePixels),
      static_cast<double>(std::clamp(most_pixels, kLeastCoarsePixels, kMostCoarsePixels)));
  const double step = std::sqrt(pixels / wanted);
  // Each cell gets as many pixels as any other.
  const auto of_side = [step](std::uint32_t side, std::uint32_t parts) {
    const auto each = static_cast<std::uint32_t>(std::lround(side / (parts * step)));
    return std::min(parts * std::max(1u, each), side);
  };
  const std::uint32_t across = of_side(image.width, cells.columns());
  const std::uint32_t count = across * of_side(image.height, cells.rows());
  const auto middle = [](std::uint32_t i, std::uint32_t of, std::uint32_t side) {
    return static_cast<std::uint32_t>((2 * std::uint64_t{i} + 1) * side / (2 * std::uint64_t{of}));
  };
  const std::uint64_t most_crossings =
      std::max(kLeastCoarseCrossings, kCoarseCrossingsPerPixel * image.width * image.height);
  const std::uint32_t stride = spreading_step(count);
  bool is_cheap = false;
  for (std::uint32_t i = 0, at = 0; i < count && trace.crossings() <= most_crossings; ++i) {
    trace.add_pixel(middle(at % across, across, image.width),
                    middle(at / across, count / across, image.height));
    // Also finished when the pixels have doubled, so that their work is known in good time.
    const std::uint32_t done = i + 1;
    if (trace.has_many_waiting() || (std::has_single_bit(done) && !is_cheap)) {
      trace.finish();
      is_cheap = done >= kTellingPixels && static_cast<double>(trace.crossings()) * count / done <
                                               kSmallPart * static_cast<double>(most_crossings);
    }
    at = (at + stride) % count;
  }
  trace.finish();
  return {trace.map(), trace.rays_per_primary(), trace.take_left_by_light()};
}

}  // namespace graycube
