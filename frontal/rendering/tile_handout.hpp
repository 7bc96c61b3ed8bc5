// Which tiles are left, which node has which, and who gets which next.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "frontal/rendering/tile_window.hpp"
#include "topology/hypercube.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class TileHandout {
 public:
  enum class Way : std::uint8_t {
    kAny,   ///< `roth`: any node gets any tile
    kOwn,   ///< each node gets those of its macro-regions
    kHelp,  ///< the same, and a node that has none left those of the neighbour
            ///< that has most
  };

  /// The plan must outlive this.
  TileHandout(const Hypercube& cube, const TilePlan& plan, Way way, const TileWindow& window);

  /// Tiles to hand to a node now, as its window allows.
  std::vector<std::uint32_t> next(Rank rank);
  /// The number of the next batch that brings a node its tiles.
  std::uint64_t next_sequence(Rank rank) { return batches_[rank.value]++; }
  /// A tile that was handed out is whole. Returns the node that had it.
  Rank is_whole(std::uint32_t tile);
  /// By rank, how many of its tiles neighbours have traced and brought back since this was last
  /// asked.
  std::vector<std::uint32_t> take_relief();
  const TileWindow& window() const { return window_; }

 private:
  void take_any(std::uint32_t& open, std::vector<std::uint32_t>& tiles);
  void take_own(Rank rank, std::uint32_t& open, std::vector<std::uint32_t>& tiles);
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
