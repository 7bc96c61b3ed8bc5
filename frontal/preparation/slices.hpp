// Chooses what each node gets of the scene: the parts that reach into its macro-regions, and
// objects that may stand between its surfaces and the lights.
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

/// A node's own slice with occluders, and its slices with copies of neighbours', may take so many
/// times an equal share of the whole scene; or so many bytes, if that is more.
inline constexpr std::uint64_t kMostShares = 2;
inline constexpr std::uint64_t kSmallSlices = std::uint64_t{1} << 20;
inline constexpr std::uint64_t kSmallCopies = std::uint64_t{256} << 10;

/// A node's foreign bounds may take this part of an equal share; or so many bytes, if that is more.
inline constexpr double kBoundsPart = 0.25;
inline constexpr std::uint64_t kSmallBounds = std::uint64_t{128} << 10;

/// Bytes for slices or bounds on each of `nodes`; the whole scene's model takes `model_bytes`.
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
  /// Each node's slice, encoded, indexed by rank.
  std::vector<SharedBytes> bytes;
  bool have_bounds = false;
};

/// Encodes the model that each node's macro-regions and own pixels need. With `tree`, which is that
/// of the whole model, nodes also get objects without bounds, and foreign bounds; with occluders,
/// unless they are empty, also the objects that the partition's pre-render asks for, as far as
/// there is room, and foreign horizons. `horizons`, encoded, come last in each slice.
Slices slices_of(const Model& model, const NodeMesh& mesh, const Partition& cut,
                 const SurfaceTree* tree, const Occluders& occluders,
                 std::span<const std::byte> horizons);

}  // namespace graycube
