// What a node holds of scene and picture while a job is on: its macro-regions, the plan of tiles,
// and the limits within which numbers in batches must lie.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "node/parts/seat.hpp"
#include "proto/batch.hpp"
#include "proto/messages.hpp"
#include "trace/domain.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

struct Holding {
  Seat seat;
  std::shared_ptr<const Domain> domain;
  TilePlan plan;
  BatchLimits limits;

  /// The holding of a node whose domain was built from the slice that came with `load`.
  static Holding of(const Seat& seat, const control::Load& load,
                    std::shared_ptr<const Domain> domain);

  bool holds(const RegionIndex& region) const { return domain->holds(region); }
  /// The link across which a ray in that region goes on; nothing when it is to be traced here.
  std::optional<std::uint32_t> next_link(const RegionIndex& region) const;
  /// Whether a ray in that region may come: it is to be traced here, or on its way through this
  /// node, from a helper to a neighbour or, where rays are finished that have left their
  /// macro-regions, from these to what they meet.
  bool is_due(const RegionIndex& region, bool neighbours_help) const;
  bool are_due(std::span<const RayTask> rays, bool neighbours_help) const;
  /// The node that traces the tile, unless tiles are everybody's as in `roth`.
  Rank owner_of_tile(std::uint32_t tile) const { return seat.owner_of(plan.owner_of_tile(tile)); }
  bool is_own_tile(std::uint32_t tile) const { return holds(plan.owner_of_tile(tile)); }
  /// Tiles that belong to this node; 0 where all are everybody's.
  std::uint64_t own_tiles() const;
  void report(control::NodeStats& stats) const;
};

}  // namespace graycube
