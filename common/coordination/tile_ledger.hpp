// The frontal's book of tile credit: which tiles are whole, that is, final.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "coordination/credit.hpp"

namespace graycube {

/// The most tiles of a picture, one for each pixel (a ledger of that many takes 3 GiB).
inline constexpr std::size_t kMaxTiles = std::size_t{1} << 26;

/// The state of a tile after credit was added to it. The last two values mean that a batch was
/// lost, repeated or forged; they leave the ledger as it was.
enum class CreditResult : std::uint8_t {
  kOpen,
  kWhole,        ///< it has just become so
  kOverflow,     ///< more credit than primary rays, or anything at all for a whole tile
  kUnknownTile,  ///< there is no tile of that number
};

class TileLedger {
 public:
  /// The number of primary rays of each tile, samples included; a tile without any is whole at
  /// once. At most kMaxTiles tiles.
  explicit TileLedger(std::vector<std::uint32_t> primary_rays_per_tile);

  CreditResult add(std::uint32_t tile, const Credit& credit);
  /// Takes all credit from a tile: it will be traced again. The tile must exist.
  void clear(std::uint32_t tile);

  /// The tile must exist.
  bool is_whole(std::uint32_t tile) const;
  bool all_whole() const { return whole_count_ == tile_count(); }
  std::size_t tile_count() const { return rays_.size(); }
  std::size_t whole_count() const { return whole_count_; }
  /// The tiles that are not whole, in order.
  std::vector<std::uint32_t> open_tiles() const;

 private:
  std::vector<std::uint32_t> rays_;
  std::vector<Credit> returned_;
  std::size_t whole_count_ = 0;
};

}  // namespace graycube
