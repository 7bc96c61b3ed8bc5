// Estimates where the work of a picture lies by tracing a few of its pixels.
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
/// Fewer pixels are traced once their rays have crossed between regions this many times per pixel
/// of the picture, or this many times in all if that is more: between mirrors and with many lights
/// a pixel can take thousands of crossings.
inline constexpr std::uint64_t kCoarseCrossingsPerPixel = 1;
inline constexpr std::uint64_t kLeastCoarseCrossings = 100'000;

/// A shadow ray that left the region it began in, with the place where it goes on.
struct LeavingLight {
  RayTask ray;
  /// The cell that it left; when all rays stay, the cell of its pixel.
  RegionIndex from;
};

struct CoarseLoad {
  /// For each cell, the cost of tracing a few evenly spread pixels, in tests of primitives.
  LoadMap map;
  /// The average number of rays that descend from a primary ray, itself included.
  double rays_per_primary;
  std::vector<LeavingLight> left_by_light;
};

/// Which kinds of rays that leave a region still count as its work, with all their descendants.
struct Staying {
  bool shadow_rays = false, secondary_rays = false;

  bool all() const { return shadow_rays && secondary_rays; }
};

/// Estimates the load of each cell, adding `crossing_cost` for each ray that comes in from another
/// cell. `whole` is the whole scene, a domain without boundaries.
CoarseLoad coarse_load(const Domain& whole, const MacroGrid& cells,
                       std::shared_ptr<const LightHorizons> horizons, Staying staying,
                       double crossing_cost, std::uint64_t most_pixels = kMostCoarsePixels);

}  // namespace graycube
