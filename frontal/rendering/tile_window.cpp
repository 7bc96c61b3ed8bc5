#include "frontal/rendering/tile_window.hpp"

#include <algorithm>

namespace graycube {
namespace {

/// The number of tiles from which at most window_rays descend, as far as the pre-render tells.
std::uint32_t most_open(const PreparedScene& scene, const FlowLimits& limits) {
  const ImageSize& image = scene.settings.image;
  const double primaries =
      static_cast<double>(image.width) * image.height * image.samples * image.samples;
  const double rays_per_tile =
      scene.rays_per_primary * primaries / static_cast<double>(scene.plan->tile_count());
  const double fitting =
      rays_per_tile > 0 ? limits.window_rays / rays_per_tile : limits.window_tiles;
  const std::uint32_t least = std::min(limits.least_window_tiles, limits.window_tiles);
  return static_cast<std::uint32_t>(std::clamp<double>(fitting, least, limits.window_tiles));
}

}  // namespace

TileWindow::TileWindow(const PreparedScene& scene, std::uint32_t nodes, std::uint32_t threads,
                       const FlowLimits& limits)
    : is_roth_(scene.algorithm == Algorithm::kRoth),
      has_replicas_(scene.has_replicas),
      nodes_(nodes),
      threads_(threads),
      tiles_(scene.plan->tile_count()),
      most_per_thread_(scene.grain == Grain::kTile ? kMostRothTilesPerThread : kRothTilesPerThread),
      most_(most_open(scene, limits)) {}

std::uint32_t TileWindow::size(std::size_t left) const {
  if (is_roth_) {
    const auto share =
        static_cast<std::uint32_t>(left / (std::size_t{kPartOfRothShare} * nodes_ * threads_));
    return std::clamp(share, kRothTilesPerThread, most_per_thread_) * threads_;
  }
  if (!has_replicas_) return most_;
  const auto part = static_cast<std::uint32_t>(left / kPartOfTilesLeft);
  return std::clamp(part, std::min(kLeastTilesPerThread * threads_, most_), most_);
}

bool TileWindow::is_worth_filling(std::uint32_t open, std::size_t left) const {
  if (is_roth_ || has_replicas_) return true;
  const std::uint32_t most = size(left);
  return most - std::min(open, most) >= most / kPartOfWindow;
}

}  // namespace graycube
