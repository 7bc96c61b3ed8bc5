#include "coordination/tile_ledger.hpp"

#include <utility>

#include "check.hpp"

namespace graycube {

TileLedger::TileLedger(std::vector<std::uint32_t> primary_rays_per_tile)
    : rays_(std::move(primary_rays_per_tile)) {
  GRAYCUBE_CHECK(rays_.size() <= kMaxTiles, "%zu tiles", rays_.size());
  returned_.resize(rays_.size());
  for (const std::uint32_t rays : rays_) whole_count_ += rays == 0 ? 1 : 0;
}

CreditResult TileLedger::add(std::uint32_t tile, const Credit& credit) {
  if (tile >= rays_.size()) return CreditResult::kUnknownTile;
  const std::uint32_t rays = rays_[tile];
  // Comparing the integer part first keeps the sum below from overflowing.
  if (is_whole(tile) || credit.words()[0] > rays) return CreditResult::kOverflow;
  Credit sum = returned_[tile];
  sum.add(credit);
  const bool whole = sum.is_exactly(rays);
  if (!whole && sum.words()[0] >= rays) return CreditResult::kOverflow;
  returned_[tile] = sum;
  if (!whole) return CreditResult::kOpen;
  ++whole_count_;
  return CreditResult::kWhole;
}

void TileLedger::clear(std::uint32_t tile) {
  if (is_whole(tile) && rays_[tile] > 0) --whole_count_;
  returned_[tile] = Credit{};
}

bool TileLedger::is_whole(std::uint32_t tile) const {
  GRAYCUBE_CHECK(tile < rays_.size(), "tile %u of %zu", tile, rays_.size());
  return returned_[tile].is_exactly(rays_[tile]);
}

std::vector<std::uint32_t> TileLedger::open_tiles() const {
  std::vector<std::uint32_t> open;
  for (std::uint32_t tile = 0; tile < rays_.size(); ++tile) {
    if (!is_whole(tile)) open.push_back(tile);
  }
  return open;
}

}  // namespace graycube
