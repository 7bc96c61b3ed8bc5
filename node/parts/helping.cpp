#include "node/parts/helping.hpp"

#include <algorithm>
#include <utility>

namespace graycube {
namespace {

/// A node gives work away from so many own tiles not begun, or received rays, on. A ray costs about
/// as much to send as to trace, so that it takes many of them.
constexpr std::size_t kTilesToShare = 2;
constexpr std::size_t kRaysToShare = 1024;
/// A neighbour gets a copy when it could take this many tiles, and one more for each kBytesPerTile
/// of the slice: to send and subdivide the slice costs about as much as to trace them.
constexpr std::size_t kTilesToCopy = 8;
constexpr std::size_t kBytesPerTile = std::size_t{16} << 10;
constexpr std::size_t kBytesPerRay = 32;
/// The work that a received ray is expected to take, in tests of a primitive.
constexpr double kRayWork = 50;
/// The work that a tile takes is known once so many tiles have been traced.
constexpr std::uint64_t kTellingTiles = 4;
/// The most rays that are given away at a time; never more than half of those here.
constexpr std::size_t kMostRaysAtATime = 512;

}  // namespace

void Helping::reset() {
  for (Neighbour& n : neighbours_)
    n = {false, Offer::kNone, n.offered_after, false, std::move(n.copy)};
  work_done_ = 0;
  tiles_traced_ = 0;
}

void Helping::offer(Mail& mail) {
  if (!rules_.is_on) return;
  for (std::uint32_t bit = 0; bit < neighbours_.size(); ++bit) {
    Neighbour& n = neighbours_[bit];
    if (std::exchange(n.was_told, true)) continue;
    const BatchType type = n.copy ? BatchType::kIdleWithCopy : BatchType::kIdle;
    mail.to_neighbour(bit, [&](const BatchStamp& stamp) {
      return encode_offer(stamp, type, static_cast<std::uint64_t>(work_done_));
    });
  }
}

void Helping::adopt(std::uint32_t bit, std::shared_ptr<const Domain> copy) {
  ++taken_.copies;
  neighbours_[bit].copy = std::move(copy);
  neighbours_[bit].was_told = false;
}

std::shared_ptr<const Domain> Helping::copy_of(std::uint32_t bit) const {
  return bit < neighbours_.size() ? neighbours_[bit].copy : nullptr;
}

void Helping::took_over(std::uint64_t tiles, std::uint64_t rays) {
  taken_.tiles += tiles;
  taken_.rays += rays;
}

bool Helping::on_offer(std::uint32_t bit, std::span<const std::byte> batch, BatchType type,
                       const BatchLimits& limits, Mail& mail) {
  Neighbour& n = neighbours_[bit];
  if (std::holds_alternative<BatchError>(decode_offer(batch, limits, n.offered_after))) {
    mail.drop("offer", "malformed");
    return false;
  }
  n.offer = type == BatchType::kIdleWithCopy ? Offer::kIdleWithCopy : Offer::kIdle;
  return true;
}

void Helping::has_traced(double work, bool is_tile) {
  work_done_ += work;
  if (is_tile) ++tiles_traced_;
}

/// The mean work of a tile, in tests of a primitive; 0 while it isn't known.
double Helping::work_of_a_tile() const {
  return tiles_traced_ < kTellingTiles ? 0 : work_done_ / static_cast<double>(tiles_traced_);
}

/// The work that an idle neighbour must take over to have done as much as this node: half of what
/// this node will have done, as far as can be told, beyond what the neighbour has. A node that is
/// idle first need not have less to do: it may have been let run first.
double Helping::work_to_spare(const Neighbour& neighbour, const Supply& supply) const {
  const double to_do =
      work_of_a_tile() * static_cast<double>(supply.tiles + supply.unassigned_tiles) +
      kRayWork * static_cast<double>(supply.rays);
  return 0.5 * (work_done_ + to_do - static_cast<double>(neighbour.offered_after));
}

bool Helping::copy_pays(const Neighbour& neighbour, const Supply& supply) const {
  const double tile = work_of_a_tile(), spare = work_to_spare(neighbour, supply);
  const std::size_t least_tiles = kTilesToCopy + rules_.slice_bytes / kBytesPerTile;
  const std::size_t least_rays = kRaysToShare + rules_.slice_bytes / kBytesPerRay;
  return (tile > 0 && supply.tiles >= 2 * least_tiles &&
          spare >= tile * static_cast<double>(least_tiles)) ||
         (supply.rays >= least_rays && spare >= 0.5 * kRayWork * static_cast<double>(least_rays));
}

/// Tiles are given rather than rays, as they are a few bytes.
Helping::Gift Helping::gift_of(const Neighbour& neighbour, const Supply& supply,
                               std::size_t most_rays) const {
  const double tile = work_of_a_tile(), spare = work_to_spare(neighbour, supply);
  if (supply.tiles >= kTilesToShare && supply.own_tiles_at_end > 0 && tile > 0 && spare >= tile) {
    return {Gift::Kind::kTiles,
            std::min({supply.tiles / 2, kMostTiles, static_cast<std::size_t>(spare / tile),
                      supply.own_tiles_at_end})};
  }
  if (supply.rays < kRaysToShare || spare < kRayWork) return {};
  const std::size_t most = std::min(
      {supply.rays / 2, kMostRaysAtATime, most_rays, static_cast<std::size_t>(spare / kRayWork)});
  if (most == 0) return {};
  return {Gift::Kind::kRays, most};
}

Helping::Gift Helping::gift_for(std::uint32_t bit, const Supply& supply, std::size_t most_rays) {
  Neighbour& n = neighbours_[bit];
  if (n.offer == Offer::kIdleWithCopy) {
    const Gift gift = gift_of(n, supply, most_rays);
    if (gift.kind != Gift::Kind::kNothing) n.offer = Offer::kNone;
    return gift;
  }
  if (n.offer != Offer::kIdle || n.was_recommended || !copy_pays(n, supply)) return {};
  n.was_recommended = true;
  return {Gift::Kind::kCopy, 0};
}

void Helping::report(control::NodeStats& stats) const {
  stats.models_borrowed += taken_.copies;
  stats.tiles_taken_over = taken_.tiles;
  stats.rays_taken_over = taken_.rays;
  for (const Neighbour& n : neighbours_) stats.memory_bytes += n.copy ? n.copy->memory_bytes() : 0;
}

}  // namespace graycube
