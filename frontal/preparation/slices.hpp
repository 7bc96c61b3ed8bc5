// What each node gets of the scene: the parts that reach into its macro-regions, and what may stand
// between its surfaces and the lights.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "crossings/surface_tree.hpp"
#include "frontal/preparation/partition.hpp"
#include "transport/message.hpp"
#include "visibility/occluders.hpp"

namespace graycube {

/// Bytes that a node may hold: so many times an equal share of the whole scene, or so many bytes
/// where that is more, for its own slice with occluders, and for slices with copies of neighbours'.
inline constexpr std::uint64_t kMostShares = 2;
inline constexpr std::uint64_t kSmallSlices = std::uint64_t{1} << 20;
inline constexpr std::uint64_t kSmallCopies = std::uint64_t{256} << 10;

/// Of an equal share of the scene, or so many bytes where that is more: foreign bounds on a node.
inline constexpr double kBoundsPart = 0.25;
inline constexpr std::uint64_t kSmallBounds = std::uint64_t{128} << 10;

/// On each of `nodes`, of a model that takes so many bytes.
constexpr std::uint64_t slice_room(std::uint64_t model_bytes, std::uint32_t nodes) {
  return std::max(kMostShares * model_bytes / nodes, kSmallSlices);
}
constexpr std::uint64_t bounds_room(std::uint64_t model_bytes, std::uint32_t nodes) {
  return std::max(
      static_cast<std::uint64_t>(kBoundsPart * static_cast<double>(model_bytes) / nodes),
      kSmallBounds);
}
constexpr std::uint64_t copy_room(std::uint64_t model_bytes, std::uint32_t nodes) {
  return std::max(kMostShares * model_bytes / nodes, kSmallCopies);
}

struct Slices {
  /// By rank.
  std::vector<SharedBytes> bytes;
  bool have_bounds = false;
};

/// The model that each node's macro-regions and own pixels need. With `tree`, of the whole model,
/// also objects without bounds, and foreign bounds; with occluders, unless they are empty, also
/// what the partition's pre-render asks for, as far as there is room, and foreign horizons.
/// `horizons`, encoded, come last.
Slices slices_of(const Model& model, const Hypercube& cube, const Partition& cut,
                 const SurfaceTree* tree, const Occluders& occluders,
                 std::span<const std::byte> horizons);

}  // namespace graycube
