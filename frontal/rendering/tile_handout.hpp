// Keeps which tiles are left and which node has which, and chooses who gets which next.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "coordination/tile_ledger.hpp"
#include "frontal/rendering/retries.hpp"
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

  /// Plan and ledger must outlive this. Tiles that are whole are not handed out.
  TileHandout(const NodeMesh& mesh, const TilePlan& plan, const TileLedger& ledger, Way way,
              const TileWindow& window);

  /// A new epoch (`retries` must outlive this): all tiles that are not whole are to be handed out,
  /// those first that were under way at most losses: the more these are, the fewer tiles are under
  /// way at a time, so that the one which brings nodes down is found.
  void reopen(const Retries& retries);
  /// Tiles that are handed out and not whole; if a rank is given, those that this node had.
  std::vector<std::uint32_t> under_way(std::optional<Rank> holder = std::nullopt) const;

  /// Takes tiles to hand to the node now, as many as its window allows, and kSliding at most
  /// `most`.
  std::vector<std::uint32_t> next(Rank rank,
                                  std::uint32_t most = std::numeric_limits<std::uint32_t>::max());
  /// kSliding: tiles that are left get new owners, listed by tile.
  void deal(const std::vector<Rank>& owners);
  /// Tiles that are left for the node to get; not for kAny.
  std::size_t left(Rank rank) const { return own_tiles_[rank.value].size(); }
  /// The same of each node, by rank; empty for kAny.
  std::vector<std::uint32_t> left_by_rank() const;
  /// The sequence number of the next batch that brings a node its tiles.
  std::uint64_t next_sequence(Rank rank) { return batches_[rank.value]++; }
  /// A tile that was handed out is whole. Returns the node that had it.
  Rank is_whole(std::uint32_t tile);
  /// How many of each node's tiles neighbours have traced and brought back since the last call,
  /// indexed by rank.
  std::vector<std::uint32_t> take_relief();
  const TileWindow& window() const { return window_; }

 private:
  void share_out();
  std::uint32_t window_before(std::uint32_t tile, std::size_t left) const;
  void take_any(std::uint32_t& open, std::vector<std::uint32_t>& tiles);
  void take_own(Rank rank, std::uint32_t most, std::uint32_t& open,
                std::vector<std::uint32_t>& tiles);
  void take_over(Rank helper, std::uint32_t& open, std::vector<std::uint32_t>& tiles);
  std::deque<std::uint32_t>& most_left_beside(Rank helper);

  NodeMesh mesh_;
  const TilePlan& plan_;
  const TileLedger& ledger_;
  Way way_;
  TileWindow window_;
  /// The node that has each tile; kNobody if it isn't handed out.
  std::vector<Rank> holder_;
  std::vector<std::deque<std::uint32_t>> own_tiles_;  // by rank, but for kAny: not handed out yet
  /// kAny: tiles that an epoch left open, and the first of those that were never handed out.
  std::deque<std::uint32_t> again_;
  std::uint32_t next_tile_ = 0;
  /// How often each tile was under way at a loss; null before the first.
  const Retries* retries_ = nullptr;
  std::vector<std::uint32_t> open_, relief_;  // by rank
  std::vector<std::uint64_t> batches_;        // by rank
};

}  // namespace graycube
