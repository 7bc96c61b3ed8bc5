// A ray under way: what an evaluator consumes, what crosses a macro-region's boundary, what goes on
// the wire.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/ray.hpp"
#include "geometry/vec.hpp"
#include "regions/macro_grid.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// Generations of the grid of macro-regions that may be in use at a time where boundaries slide:
/// the one whose tiles are handed out, and the one before while tiles of it are open, or the one
/// after while nodes get ready for it. A node holds as many slices.
inline constexpr std::uint32_t kMostGenerations = 2;

enum class RayKind : std::uint8_t { kPrimary, kShadow, kReflection, kRefraction };
inline constexpr int kRayKinds = 4;

struct RayTask {
  /// The ray as created; never restarted at a boundary, so that every node computes the same t.
  Ray ray;
  /// The parameter reached so far: crossings before it are behind the ray.
  double t = 0;
  /// For shadow rays, the end: crossings at or beyond it don't exist or don't count. Else infinity.
  double t_max = 0;
  /// The product of Kr and Kt from the root of the photometric tree; for a shadow ray the light
  /// that arrives if nothing opaque stands in the way.
  Rgb weight;
  /// y · width + x.
  std::uint32_t pixel = 0;
  RayKind kind = RayKind::kPrimary;
  /// e: the ray holds 2^-e of its primary ray's credit.
  std::uint8_t credit_exponent = 0;
  /// Generation: 0 for primary rays; a shadow ray has that of the surface it left.
  std::uint16_t depth = 0;
  /// For shadow rays, the index of their light in the settings, and whether t_max is where they
  /// reach that light's horizon.
  std::uint16_t light : 14 = 0;
  bool ends_at_horizon : 1 = false;
  /// Where boundaries slide: the generation of the grid that is the ray's for life, modulo
  /// kMostGenerations (docs/design/sliding.md).
  std::uint16_t generation : 1 = 0;
  /// The macro-region that the ray is in at t.
  RegionIndex region;
  /// Links crossed since the primary ray, by this ray and those that it descends from: its class in
  /// the flow of rays.
  std::uint16_t hops = 0;

  friend bool operator==(const RayTask&, const RayTask&) = default;
};

/// The largest number that RayTask::light can hold.
inline constexpr std::uint32_t kLightMask = (1u << 14) - 1;
static_assert(kMaxLights <= kLightMask + 1);

inline constexpr std::uint32_t kMaxHops = 0xFFFF;

/// More links than any ray of such a job can have crossed: a primary ray stays in its macro-region;
/// each further generation is sent to where it begins, over as many links as the hypercube has
/// dimensions at most, and passes each boundary once; and what a neighbour traces for its owner
/// crosses two links for one.
constexpr std::uint64_t most_hops(std::uint32_t max_depth, std::uint32_t columns,
                                  std::uint32_t rows) {
  const auto dimension = static_cast<std::uint32_t>(std::bit_width(columns) + std::bit_width(rows));
  return std::uint64_t{2} * (max_depth + 1) * (columns + rows + dimension);
}

inline void cross_link(RayTask& ray) {
  if (ray.hops < kMaxHops) ++ray.hops;
}

/// Calls f(key, rays) for each run of rays with one key(ray).
template <typename Key, typename F>
void for_each_run(std::span<const RayTask> rays, Key&& key, F&& f) {
  while (!rays.empty()) {
    const auto first = key(rays.front());
    std::size_t count = 1;
    while (count < rays.size() && key(rays[count]) == first) ++count;
    f(first, rays.first(count));
    rays = rays.subspan(count);
  }
}

/// Calls f(region, rays) for each run of rays that are in one region.
template <typename F>
void for_each_region(std::span<const RayTask> rays, F&& f) {
  for_each_run(
      rays, [](const RayTask& ray) { return ray.region; }, f);
}

}  // namespace graycube
