#include "frontal/rendering/tile_handout.hpp"

#include <algorithm>
#include <utility>

#include "proto/share_of.hpp"

namespace graycube {
namespace {

constexpr Rank kNobody{0xFFFF'FFFF};
/// For each loss at which a tile was under way, a node may have 2^this times fewer tiles open.
constexpr std::uint32_t kNarrowing = 3;

}  // namespace

TileHandout::TileHandout(const NodeMesh& mesh, const TilePlan& plan, const TileLedger& ledger,
                         Way way, const TileWindow& window)
    : mesh_(mesh),
      plan_(plan),
      ledger_(ledger),
      way_(way),
      window_(window),
      holder_(plan.tile_count(), kNobody),
      open_(mesh.cube().nodes(), 0),
      relief_(mesh.cube().nodes(), 0),
      batches_(mesh.cube().nodes(), 0) {
  if (way_ != Way::kAny) share_out();
}

/// Gives each node those of its tiles that are not whole.
void TileHandout::share_out() {
  const auto is_whole = [this](std::uint32_t tile) { return ledger_.is_whole(tile); };
  own_tiles_.clear();
  for (std::uint32_t rank = 0; rank < mesh_.cube().nodes(); ++rank) {
    const auto tiles = plan_.tiles_of(share_of(mesh_, Rank{rank}));
    own_tiles_.emplace_back(tiles.begin(), tiles.end());
    std::erase_if(own_tiles_.back(), is_whole);
  }
}

void TileHandout::reopen(const Retries& retries) {
  retries_ = &retries;
  const auto is_worse = [&retries](std::uint32_t a, std::uint32_t b) {
    return retries.losses_of(a) > retries.losses_of(b);
  };
  if (way_ == Way::kAny) {
    const std::vector<std::uint32_t> again = under_way();
    again_.insert(again_.end(), again.begin(), again.end());
    std::ranges::stable_sort(again_, is_worse);
  } else {
    share_out();
    for (auto& own : own_tiles_) std::ranges::stable_sort(own, is_worse);
  }
  std::ranges::fill(holder_, kNobody);
  std::ranges::fill(open_, 0);
  std::ranges::fill(relief_, 0);
  std::ranges::fill(batches_, 0);
}

std::vector<std::uint32_t> TileHandout::under_way(std::optional<Rank> holder) const {
  std::vector<std::uint32_t> tiles;
  for (std::uint32_t tile = 0; tile < holder_.size(); ++tile) {
    if (holder_[tile] == kNobody || (holder && holder_[tile] != *holder)) continue;
    if (!ledger_.is_whole(tile)) tiles.push_back(tile);
  }
  return tiles;
}

std::vector<std::uint32_t> TileHandout::left_by_rank() const {
  std::vector<std::uint32_t> left;
  for (const auto& own : own_tiles_) left.push_back(static_cast<std::uint32_t>(own.size()));
  return left;
}

/// How many tiles a node may have open when this one is next, of `left`.
std::uint32_t TileHandout::window_before(std::uint32_t tile, std::size_t left) const {
  const std::uint32_t size = window_.size(left);
  const std::uint32_t losses = retries_ == nullptr ? 0 : retries_->losses_of(tile);
  return std::max(1u, size >> std::min(31u, kNarrowing * losses));
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
  for (;;) {
    while (again_.empty() && next_tile_ < holder_.size() && ledger_.is_whole(next_tile_))
      ++next_tile_;
    if (again_.empty() && next_tile_ == holder_.size()) return;
    const std::uint32_t tile = again_.empty() ? next_tile_ : again_.front();
    if (open >= window_before(tile, again_.size() + holder_.size() - next_tile_)) return;
    again_.empty() ? static_cast<void>(++next_tile_) : again_.pop_front();
    tiles.push_back(tile);
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
  while (!own.empty() && tiles.size() < most && open < window_before(own.front(), own.size())) {
    tiles.push_back(own.front());
    own.pop_front();
    ++open;
  }
}

void TileHandout::take_over(Rank helper, std::uint32_t& open, std::vector<std::uint32_t>& tiles) {
  while (own_tiles_[helper.value].empty() && mesh_.cube().dimension() > 0) {
    auto& theirs = most_left_beside(helper);
    if (theirs.empty() || open >= window_before(theirs.back(), theirs.size())) break;
    // The helper takes tiles from the far end, as the owner takes them from the front.
    tiles.push_back(theirs.back());
    theirs.pop_back();
    ++open;
  }
}

std::deque<std::uint32_t>& TileHandout::most_left_beside(Rank helper) {
  std::deque<std::uint32_t>* most = nullptr;
  for (std::uint32_t bit = 0; bit < mesh_.cube().dimension(); ++bit) {
    auto& theirs = own_tiles_[mesh_.cube().neighbour(helper, bit).value];
    if (most == nullptr || theirs.size() > most->size()) most = &theirs;
  }
  return *most;
}

Rank TileHandout::is_whole(std::uint32_t tile) {
  const Rank holder = holder_[tile];
  --open_[holder.value];
  if (way_ == Way::kAny || way_ == Way::kSliding) return holder;
  const RegionIndex region = plan_.owner_of_tile(tile);
  const Rank owner = mesh_.owner_of(region.column, region.row, region.slab);
  if (holder != owner) ++relief_[owner.value];
  return holder;
}

std::vector<std::uint32_t> TileHandout::take_relief() {
  return std::exchange(relief_, std::vector<std::uint32_t>(mesh_.cube().nodes(), 0));
}

}  // namespace graycube
