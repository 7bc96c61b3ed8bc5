#include "frontal/rendering/light_intake.hpp"

#include <algorithm>
#include <numeric>

#include "proto/records/tile_records.hpp"
#include "regions/pixels_of.hpp"

namespace graycube {
namespace {

std::vector<std::uint32_t> rays_per_tile(const TilePlan& plan) {
  std::vector<std::uint32_t> rays(plan.tile_count());
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    rays[i] = static_cast<std::uint32_t>(plan.primary_rays(i));
  }
  return rays;
}

}  // namespace

LightIntake::LightIntake(std::uint32_t job, const RenderSettings& settings, const TilePlan& plan,
                         std::uint32_t nodes)
    : job_(job),
      film_(settings.image.width, settings.image.height,
            settings.image.samples * settings.image.samples, settings.aovs),
      ledger_(rays_per_tile(plan)),
      batches_(nodes, 0) {
  limits_.pixel_count = (1 + kAovPlanes) * film_.pixel_count();
  limits_.tile_count = static_cast<std::uint32_t>(ledger_.tile_count());
  limits_.max_depth = settings.max_depth;
  limits_.nodes = nodes;
}

void LightIntake::reopen(const TilePlan& plan) {
  std::ranges::fill(batches_, 0);
  const std::uint32_t width = film_.width();
  for (const std::uint32_t tile : ledger_.open_tiles()) {
    ledger_.clear(tile);
    each_pixel_of(plan.rect(tile), width, [this](std::uint32_t p, std::size_t) { film_.clear(p); });
  }
}

std::uint32_t LightIntake::restore(std::span<const std::byte> records, const TilePlan& plan) {
  const std::vector<bool> known = restore_tiles(records, film_);
  std::uint32_t restored = 0;
  for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
    if (ledger_.is_whole(tile)) continue;
    const bool is_last_open = ledger_.whole_count() + 1 == ledger_.tile_count();
    std::vector<std::uint32_t> pixels;
    each_pixel_of(plan.rect(tile), film_.width(),
                  [&](std::uint32_t p, std::size_t) { pixels.push_back(p); });
    if (!is_last_open && std::ranges::all_of(pixels, [&](std::uint32_t p) { return known[p]; })) {
      const auto rays = plan.primary_rays(tile);
      ledger_.add(tile, Credit::from_words({rays, 0, 0, 0, 0}));
      ++restored;
    } else {
      for (const std::uint32_t p : pixels) film_.clear(p);
    }
  }
  return restored;
}

LightIntake::Taken LightIntake::take(std::span<const std::byte> batch, std::uint32_t epoch) {
  const auto result = decode_contributions(batch, limits_, credits_, contributions_);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    return {"a broken batch of contributions: " + std::string(to_string(*error)), false, {}};
  }
  const BatchStamp& s = std::get<BatchHeader>(result).stamp;
  if (s.job != job_ || s.epoch != epoch) return {};
  if (s.sender >= batches_.size() || s.sequence != batches_[s.sender]) {
    return {
        "a batch of contributions from node " + std::to_string(s.sender) + " was lost", true, {}};
  }
  ++batches_[s.sender];
  Taken taken{add_light(), false, {}};
  if (taken.wrong.empty()) taken.wrong = add_credit(taken.whole);
  return taken;
}

std::string LightIntake::add_light() {
  for (const Contribution& c : contributions_) {
    if (c.pixel >= film_.pixel_count() && !film_.has_slot(c.pixel))
      return "a contribution to AOVs that nobody asked for";
    film_.add(c.pixel, c.light);
  }
  return {};
}

std::string LightIntake::add_credit(std::vector<std::uint32_t>& whole) {
  for (const TileCredit& c : credits_) {
    switch (ledger_.add(c.tile, c.credit)) {
      case CreditResult::kOpen: break;
      case CreditResult::kWhole: whole.push_back(c.tile); break;
      case CreditResult::kOverflow:
      case CreditResult::kUnknownTile:
        return "internal error: more was done of part " + std::to_string(c.tile) +
               " of the picture than there is of it";
    }
  }
  return {};
}

std::uint64_t LightIntake::batches() const {
  return std::accumulate(batches_.begin(), batches_.end(), std::uint64_t{0});
}

}  // namespace graycube
