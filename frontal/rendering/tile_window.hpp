// How many tiles a node may have open at a time: open until the frontal holds all their light.
#pragma once

#include <cstddef>
#include <cstdint>

#include "frontal/preparation/preparation.hpp"
#include "frontal/rendering/flow_limits.hpp"

namespace graycube {

/// Tiles are handed out again once this part of the window is free.
inline constexpr std::uint32_t kPartOfWindow = 4;
/// The least and the most tiles that a node may have open per evaluator thread in `roth`. While
/// many are left it may have this part of an equal share of them, so that light comes in fewer
/// messages; pixels and lines are handed out by the least only, as in 1987.
inline constexpr std::uint32_t kRothTilesPerThread = 2;
inline constexpr std::uint32_t kMostRothTilesPerThread = 16;
inline constexpr std::uint32_t kPartOfRothShare = 4;
/// Where nodes hold replicas, a node has at least so many tiles open per evaluator thread, and
/// otherwise this part of those that are left: the fewer, the more of them can still be taken over.
inline constexpr std::uint32_t kLeastTilesPerThread = 4;
inline constexpr std::uint32_t kPartOfTilesLeft = 4;

class TileWindow {
 public:
  TileWindow(const PreparedScene& scene, std::uint32_t nodes, std::uint32_t threads,
             const FlowLimits& limits);

  /// Tiles that a node may have open when `left` are left of those that it takes from.
  std::uint32_t size(std::size_t left) const;
  /// The size that nodes are told at the start, before any tile is handed out.
  std::uint32_t first_size() const { return is_roth_ ? size(tiles_) : most_; }
  /// Whether so much of the window is free that it pays to hand out tiles: a message for each tile
  /// that becomes whole would wake a node for next to nothing.
  bool is_worth_filling(std::uint32_t open, std::size_t left) const;

 private:
  bool is_roth_, has_replicas_;
  std::uint32_t nodes_, threads_;
  std::size_t tiles_;
  /// The most tiles for each evaluator thread of a node in `roth`.
  std::uint32_t most_per_thread_;
  /// The most tiles that a node may have open in `macro`.
  std::uint32_t most_;
};

}  // namespace graycube
