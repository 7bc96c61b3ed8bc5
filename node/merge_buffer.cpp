#include "node/merge_buffer.hpp"

#include <algorithm>
#include <utility>

namespace graycube {
namespace {

/// Whether one record can't hold both.
bool is_too_much(const FixedRgb& a, const FixedRgb& b) {
  return a.r > kMaxMergedLight - b.r || a.g > kMaxMergedLight - b.g || a.b > kMaxMergedLight - b.b;
}

}  // namespace

std::uint32_t& MergeBuffer::Index::place_of(std::uint32_t key, std::uint32_t next) {
  // Fibonacci hashing of short rows of pixels: those of one lie side by side, as they are looked for.
  constexpr std::uint32_t kGolden = 2654435769u, kRow = 16;
  if (slots_.empty()) slots_.resize(2 * keys_);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = (key / kRow * kGolden * kRow + key % kRow) & mask;; i = (i + 1) & mask) {
    Slot& slot = slots_[i];
    if (slot.generation != generation_) {
      slot = {key, next, generation_};
      return slot.place;
    }
    if (slot.key == key) return slot.place;
  }
}

void MergeBuffer::Index::clear() {
  if (++generation_ != 0) return;
  std::fill(slots_.begin(), slots_.end(), Slot{});
  generation_ = 1;
}

void MergeBuffer::Index::resize(std::size_t keys) {
  keys_ = keys;
  slots_ = {};
  generation_ = 1;
}

MergeBuffer::MergeBuffer() { clear(); }

void MergeBuffer::expect_others(bool others) {
  const std::size_t most = others ? kMostPixels : kFullPixels;
  full_ = others ? kFullOfOthers : kFullPixels;
  if (most != std::exchange(most_, most)) {
    pixels_.resize(most);
    tiles_.resize(most);
  }
  clear();
}

void MergeBuffer::clear() {
  merged_ = {};
  merged_.contributions.reserve(kFullPixels);
  pixels_.clear();
  tiles_.clear();
}

std::size_t MergeBuffer::add(std::span<const PixelReturn> returns, const TilePlan& plan) {
  std::size_t taken = 0;
  for (; taken < returns.size() && !is_full(); ++taken) {
    const PixelReturn& r = returns[taken];
    // AOVs bring no credit: that of their ray follows with its light.
    if (r.pixel < plan.pixel_count()) add_credit(plan.tile_of_pixel(r.pixel), r.credit);
    if (r.merged > 0) add_light(r.pixel, r.light);
  }
  return taken;
}

bool MergeBuffer::add_gathered(std::span<const TileCredit> credits,
                               std::span<const Contribution> contributions) {
  if (merged_.credits.size() + credits.size() > most_ ||
      merged_.contributions.size() + contributions.size() > most_) {
    return false;
  }
  for (const TileCredit& c : credits) add_credit(c.tile, c.credit);
  for (const Contribution& c : contributions) add_light(c.pixel, c.light);
  return true;
}

std::size_t MergeBuffer::add_tile(std::span<const PixelReturn> returns, std::uint32_t tile,
                                  const TilePlan& plan) {
  auto& all = merged_.contributions;
  const std::size_t room = is_full() ? 0 : full_ - all.size();
  const auto taken = returns.first(std::min(returns.size(), room));
  Credit credit;
  for (const PixelReturn& r : taken) {
    if (r.pixel < plan.pixel_count()) credit.add(r.credit);
    if (r.merged > 0) all.push_back({r.pixel, r.light});
  }
  if (!taken.empty()) add_credit(tile, credit);
  return taken.size();
}

void MergeBuffer::add_credit(std::uint32_t tile, const Credit& credit) {
  auto& all = merged_.credits;
  // Mostly they come tile by tile.
  if (!all.empty() && all.back().tile == tile) return all.back().credit.add(credit);
  const auto next = static_cast<std::uint32_t>(all.size());
  const std::uint32_t place = tiles_.place_of(tile, next);
  if (place == next) {
    all.push_back({tile, credit});
  } else {
    all[place].credit.add(credit);
  }
}

void MergeBuffer::add_light(std::uint32_t pixel, const FixedRgb& light) {
  auto& all = merged_.contributions;
  const auto next = static_cast<std::uint32_t>(all.size());
  std::uint32_t& place = pixels_.place_of(pixel, next);
  if (place != next && is_too_much(all[place].light, light)) place = next;
  if (place == next) {
    all.push_back({pixel, light});
  } else {
    all[place].light.add(light);
  }
}

MergeBuffer::Merged MergeBuffer::take() {
  Merged taken = std::move(merged_);
  clear();
  return taken;
}

}  // namespace graycube
