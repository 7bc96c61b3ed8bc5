// Where the work of a picture lies, from tracing a few of its pixels.
#pragma once

#include "regions/rectilinear.hpp"
#include "trace/domain.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// Pixels that are traced: about this share of the picture, within these bounds, and no more than
/// the caller asks for.
inline constexpr double kCoarseShare = 0.0078;
inline constexpr std::uint64_t kLeastCoarsePixels = 1024;
inline constexpr std::uint64_t kMostCoarsePixels = 16384;
/// Fewer where their rays have crossed from region to region so many times for each pixel of the
/// picture, or so many in all where that is more: between mirrors and with many lights a pixel can
/// take thousands.
inline constexpr std::uint64_t kCoarseCrossingsPerPixel = 1;
inline constexpr std::uint64_t kLeastCoarseCrossings = 100'000;

/// A shadow ray that left what is traced together, with where it goes on.
struct LeavingLight {
  RayTask ray;
  /// The cell from which it left; where all rays stay, its pixel's.
  RegionIndex from;
};

struct CoarseLoad {
  /// By cell, what tracing a few evenly spread pixels took there, in tests of primitives.
  LoadMap map;
  /// The rays that descend from a primary ray, itself included, on average.
  double rays_per_primary;
  std::vector<LeavingLight> left_by_light;
};

/// Which rays that leave a region are traced there all the same, with all that descends from them.
struct Staying {
  bool shadow_rays = false, secondary_rays = false;

  bool all() const { return shadow_rays && secondary_rays; }
};

/// By cell, with `crossing_cost` for each ray that came in from the cell beside. `whole` has no
/// boundaries.
CoarseLoad coarse_load(const Domain& whole, const MacroGrid& cells,
                       std::shared_ptr<const LightHorizons> horizons, Staying staying,
                       double crossing_cost, std::uint64_t most_pixels = kMostCoarsePixels);

}  // namespace graycube
