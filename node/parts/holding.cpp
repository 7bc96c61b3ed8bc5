#include "node/parts/holding.hpp"

#include <algorithm>
#include <utility>

#include "proto/job_settings.hpp"

namespace graycube {
namespace {

TilePlan plan_of(const control::Load& load, const Domain& domain) {
  const ImageSize& image = domain.settings().image;
  const TileShape shape = tile_shape(load.grain, load.tile_size, image);
  if (domain.grid() == nullptr) return {image, shape};
  return {image, shape, *domain.grid(), load.grid.own_edges};
}

BatchLimits limits_of(const Seat& seat, const Domain& domain, const TilePlan& plan) {
  const RenderSettings& settings = domain.settings();
  BatchLimits limits;
  limits.pixel_count = plan.pixel_count();
  limits.tile_count = plan.tile_count();
  limits.max_depth = settings.max_depth;
  limits.lights = std::max(1u, static_cast<std::uint32_t>(settings.lights.size()));
  limits.columns = domain.grid() != nullptr ? domain.grid()->columns() : 1;
  limits.rows = domain.grid() != nullptr ? domain.grid()->rows() : 1;
  limits.nodes = seat.cube.nodes();
  limits.max_hops = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(most_hops(limits.max_depth, limits.columns, limits.rows), kMaxHops));
  return limits;
}

}  // namespace

Holding Holding::of(const Seat& seat, const control::Load& load,
                    std::shared_ptr<const Domain> domain) {
  TilePlan plan = plan_of(load, *domain);
  BatchLimits limits = limits_of(seat, *domain, plan);
  limits.are_rays_numbered = load.returns == ReturnsMode::kSender;
  limits.may_slide = load.boundaries == BoundariesMode::kSliding;
  return {seat, std::move(domain), std::move(plan), limits};
}

std::optional<std::uint32_t> Holding::next_link(const RegionIndex& region) const {
  if (holds(region)) return std::nullopt;
  return seat.bit_towards(region);
}

bool Holding::is_due(const RegionIndex& region, bool neighbours_help) const {
  if (holds(region) || domain->has_foreign_bounds()) return true;
  return neighbours_help && seat.bit_of(seat.owner_of(region)) < seat.links();
}

bool Holding::are_due(std::span<const RayTask> rays, bool neighbours_help) const {
  return std::ranges::all_of(
      rays, [&](const RayTask& ray) { return is_due(ray.region, neighbours_help); });
}

std::uint64_t Holding::own_tiles() const {
  return domain->grid() != nullptr ? plan.tiles_of(seat.share()).size() : 0;
}

void Holding::report(control::NodeStats& stats) const {
  stats.primitives = domain->model().primitives.size();
  stats.memory_bytes = domain->memory_bytes();
  stats.cells = domain->cell_count();
}

}  // namespace graycube
