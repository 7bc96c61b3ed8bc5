#include "node/merge_buffer.hpp"

#include <algorithm>

namespace graycube {

MergeBuffer::Merged MergeBuffer::take(const TilePlan& plan) {
  const std::size_t count = std::min(returns_.size(), kFullReturns);
  const auto end = returns_.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(returns_.begin(), end,
            [](const PixelReturn& a, const PixelReturn& b) { return a.pixel < b.pixel; });
  Merged merged;
  std::uint32_t in_last = 0;
  for (auto it = returns_.begin(); it != end; ++it) {
    // AOVs bring no credit: that of their ray follows with its light.
    if (it->pixel < plan.pixel_count()) {
      merged.credits.push_back({plan.tile_of_pixel(it->pixel), it->credit});
    }
    if (it->merged == 0) continue;
    auto& all = merged.contributions;
    if (all.empty() || all.back().pixel != it->pixel ||
        in_last + it->merged > kMaxMergedContributions) {
      all.push_back({it->pixel, {}});
      in_last = 0;
    }
    all.back().light.add(it->light);
    in_last += it->merged;
  }
  returns_.erase(returns_.begin(), end);
  auto& credits = merged.credits;
  std::sort(credits.begin(), credits.end(),
            [](const TileCredit& a, const TileCredit& b) { return a.tile < b.tile; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < credits.size(); ++i) {
    if (kept > 0 && credits[kept - 1].tile == credits[i].tile) {
      credits[kept - 1].credit.add(credits[i].credit);
    } else {
      credits[kept++] = credits[i];
    }
  }
  credits.resize(kept);
  return merged;
}

}  // namespace graycube
