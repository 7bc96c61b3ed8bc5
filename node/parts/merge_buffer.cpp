#include "node/parts/merge_buffer.hpp"

#include <algorithm>

namespace graycube {

/// The slot of the key, or the free one where it goes.
MergeBuffer::Index::Slot& MergeBuffer::Index::slot_of(std::uint32_t key) {
  // Fibonacci hashing of short rows of pixels: the pixels of a row, which are looked up one after
  // the other, lie side by side.
  constexpr std::uint32_t kGolden = 2654435769u, kRow = 16;
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = (key / kRow * kGolden * kRow + key % kRow) & mask;
  while (slots_[i].generation == generation_ && slots_[i].key != key) i = (i + 1) & mask;
  return slots_[i];
}

std::uint32_t& MergeBuffer::Index::place_of(std::uint32_t key, std::uint32_t next) {
  if (2 * (count_ + 1) > slots_.size()) grow();
  Slot& slot = slot_of(key);
  if (slot.generation != generation_) {
    slot = {key, next, generation_};
    ++count_;
  }
  return slot.place;
}

void MergeBuffer::Index::grow() {
  std::vector<Slot> before(std::max(kFewSlots, 2 * slots_.size()));
  before.swap(slots_);
  for (const Slot& slot : before) {
    if (slot.generation == generation_) slot_of(slot.key) = slot;
  }
}

void MergeBuffer::Index::clear() {
  count_ = 0;
  if (++generation_ != 0) return;
  std::fill(slots_.begin(), slots_.end(), Slot{});
  generation_ = 1;
}

MergeBuffer::MergeBuffer() { clear(); }

void MergeBuffer::expect_others(bool others) {
  most_ = others ? kMostPixels : kFullPixels;
  full_ = others ? kFullOfOthers : kFullPixels;
  clear();
}

void MergeBuffer::clear() {
  merged_.credits.clear();
  merged_.contributions.clear();
  pixels_.clear();
  tiles_.clear();
}

/// Called when the first light comes: by then the slice that a node was built from has been freed,
/// and this takes its place.
void MergeBuffer::make_room() {
  if (merged_.contributions.capacity() == 0) merged_.contributions.reserve(kFullPixels);
}

std::size_t MergeBuffer::add(std::span<const PixelReturn> returns, const TilePlan& plan) {
  make_room();
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
  make_room();
  for (const TileCredit& c : credits) add_credit(c.tile, c.credit);
  for (const Contribution& c : contributions) add_light(c.pixel, c.light);
  return true;
}

std::size_t MergeBuffer::add_tile(std::span<const PixelReturn> returns, std::uint32_t tile,
                                  const TilePlan& plan) {
  make_room();
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
  // Returns mostly come tile by tile.
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

}  // namespace graycube
