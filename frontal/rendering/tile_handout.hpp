// Keeps which tiles are left and which node has which, and chooses who gets which next.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "frontal/rendering/tile_window.hpp"
#include "topology/hypercube.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class TileHandout {
 public:
  enum class Way : std::uint8_t {
    kAny,      ///< `roth`: any node gets any tile
    kOwn,      ///< each node gets tiles of its macro-regions
    kHelp,     ///< the same, and a node that has none left gets tiles of the
               ///< neighbour that has most left
    kSliding,  ///< each node gets tiles of its macro-region of the moment
  };

  /// The plan must outlive this.
  TileHandout(const Hypercube& cube, const TilePlan& plan, Way way, const TileWindow& window);

  /// Takes tiles to hand to the node now, as many as its window allows, and kSliding at most
  /// `most`.
  std::vector<std::uint32_t> next(Rank rank,
                                  std::uint32_t most = std::numeric_limits<std::uint32_t>::max());
  /// kSliding: tiles that are left get new owners, listed by tile.
  void deal(const std::vector<Rank>& owners);
  /// Tiles that are left for the node to get; not for kAny.
  std::size_t left(Rank rank) const { return own_tiles_[rank.value].size(); }
  /// The sequence number of the next batch that brings a node its tiles.
  std::uint64_t next_sequence(Rank rank) { return batches_[rank.value]++; }
  /// A tile that was handed out is whole. Returns the node that had it.
  Rank is_whole(std::uint32_t tile);
  /// How many of each node's tiles neighbours have traced and brought back since the last call,
  /// indexed by rank.
  std::vector<std::uint32_t> take_relief();
  const TileWindow& window() const { return window_; }

 private:
  void take_any(std::uint32_t& open, std::vector<std::uint32_t>& tiles);
  void take_own(Rank rank, std::uint32_t most, std::uint32_t& open,
                std::vector<std::uint32_t>& tiles);
  void take_over(Rank helper, std::uint32_t& open, std::vector<std::uint32_t>& tiles);
  std::deque<std::uint32_t>& most_left_beside(Rank helper);

  Hypercube cube_;
  const TilePlan& plan_;
  Way way_;
  TileWindow window_;
  std::vector<Rank> holder_;                          // of each tile handed out
  std::vector<std::deque<std::uint32_t>> own_tiles_;  // by rank, but for kAny: not handed out yet
  std::uint32_t next_tile_ = 0;                       // kAny
  std::vector<std::uint32_t> open_, relief_;          // by rank
  std::vector<std::uint64_t> batches_;                // by rank
};

}  // namespace graycube
