#include "frontal/rendering/tile_handout.hpp"

#include <algorithm>
#include <utility>

#include "proto/share_of.hpp"

namespace graycube {

TileHandout::TileHandout(const Hypercube& cube, const TilePlan& plan, Way way,
                         const TileWindow& window)
    : cube_(cube),
      plan_(plan),
      way_(way),
      window_(window),
      holder_(plan.tile_count()),
      open_(cube.nodes(), 0),
      relief_(cube.nodes(), 0),
      batches_(cube.nodes(), 0) {
  if (way_ == Way::kAny) return;
  for (std::uint32_t rank = 0; rank < cube_.nodes(); ++rank) {
    const auto tiles = plan_.tiles_of(share_of(cube_, Rank{rank}));
    own_tiles_.emplace_back(tiles.begin(), tiles.end());
  }
}

std::vector<std::uint32_t> TileHandout::next(Rank rank, std::uint32_t most) {
  std::vector<std::uint32_t> tiles;
  std::uint32_t& open = open_[rank.value];
  if (way_ == Way::kAny) {
    take_any(open, tiles);
  } else if (window_.is_worth_filling(open, own_tiles_[rank.value].size())) {
    take_own(rank, most, open, tiles);
    if (way_ == Way::kHelp) take_over(rank, open, tiles);
  }
  for (const std::uint32_t tile : tiles) holder_[tile] = rank;
  return tiles;
}

void TileHandout::take_any(std::uint32_t& open, std::vector<std::uint32_t>& tiles) {
  while (next_tile_ < holder_.size() && open < window_.size(holder_.size() - next_tile_)) {
    tiles.push_back(next_tile_++);
    ++open;
  }
}

void TileHandout::deal(const std::vector<Rank>& owners) {
  std::vector<std::uint32_t> tiles;
  for (auto& own : own_tiles_) {
    tiles.insert(tiles.end(), own.begin(), own.end());
    own.clear();
  }
  std::sort(tiles.begin(), tiles.end());
  for (const std::uint32_t tile : tiles) own_tiles_[owners[tile].value].push_back(tile);
}

void TileHandout::take_own(Rank rank, std::uint32_t most, std::uint32_t& open,
                           std::vector<std::uint32_t>& tiles) {
  auto& own = own_tiles_[rank.value];
  while (!own.empty() && tiles.size() < most && open < window_.size(own.size())) {
    tiles.push_back(own.front());
    own.pop_front();
    ++open;
  }
}

void TileHandout::take_over(Rank helper, std::uint32_t& open, std::vector<std::uint32_t>& tiles) {
  while (own_tiles_[helper.value].empty() && cube_.dimension() > 0) {
    auto& theirs = most_left_beside(helper);
    if (theirs.empty() || open >= window_.size(theirs.size())) break;
    // The helper takes tiles from the far end, as the owner takes them from the front.
    tiles.push_back(theirs.back());
    theirs.pop_back();
    ++open;
  }
}

std::deque<std::uint32_t>& TileHandout::most_left_beside(Rank helper) {
  std::deque<std::uint32_t>* most = nullptr;
  for (std::uint32_t bit = 0; bit < cube_.dimension(); ++bit) {
    auto& theirs = own_tiles_[cube_.neighbour(helper, bit).value];
    if (most == nullptr || theirs.size() > most->size()) most = &theirs;
  }
  return *most;
}

Rank TileHandout::is_whole(std::uint32_t tile) {
  const Rank holder = holder_[tile];
  --open_[holder.value];
  if (way_ == Way::kAny || way_ == Way::kSliding) return holder;
  const RegionIndex region = plan_.owner_of_tile(tile);
  const Rank owner = cube_.owner_of(region.column, region.row);
  if (holder != owner) ++relief_[owner.value];
  return holder;
}

std::vector<std::uint32_t> TileHandout::take_relief() {
  return std::exchange(relief_, std::vector<std::uint32_t>(cube_.nodes(), 0));
}

}  // namespace graycube
