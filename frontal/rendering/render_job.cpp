#include "frontal/rendering/render_job.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "proto/share_of.hpp"

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

RenderJob::RenderJob(std::uint32_t job, PreparedScene scene, const Hypercube& cube,
                     std::uint32_t threads, const FlowLimits& limits, SumsMode sums)
    : job_(job),
      scene_(std::move(scene)),
      cube_(cube),
      nodes_(cube.nodes()),
      threads_(threads),
      limits_(limits),
      sums_(sums),
      film_(scene_.settings.image.width, scene_.settings.image.height,
            scene_.settings.image.samples * scene_.settings.image.samples, scene_.settings.aovs),
      ledger_(rays_per_tile(*scene_.plan)),
      holder_(scene_.plan->tile_count()),
      open_(nodes_, 0),
      relief_(nodes_, 0),
      copies_(nodes_, 0),
      ready_(nodes_, false),
      reported_(nodes_, false),
      batches_received_(nodes_, 0),
      assignments_sent_(nodes_, 0),
      reports_(nodes_) {
  for (std::uint32_t rank = 0; rank < nodes_; ++rank) {
    reports_[rank].rank = rank;
    reports_[rank].gray = cube_.label_of(Rank{rank}).value;
  }
  if (is_roth()) return;
  for (const SharedBytes& slice : scene_.slices) slice_bytes_.push_back(slice.size());
  held_bytes_ = slice_bytes_;
  for (std::uint32_t rank = 0; rank < nodes_; ++rank) {
    const auto tiles = scene_.plan->tiles_of(share_of(cube_, Rank{rank}));
    own_tiles_.emplace_back(tiles.begin(), tiles.end());
  }
}

SharedBytes RenderJob::take_slice(Rank rank) {
  if (scene_.slices.size() == 1) return scene_.slices.front();
  SharedBytes& held = scene_.slices[rank.value];
  return lends() || may_be_copied(rank) ? held : std::exchange(held, {});
}

const SharedBytes* RenderJob::slice_to_lend(std::uint32_t rank) const {
  return lends() && rank < nodes_ ? &scene_.slices[rank] : nullptr;
}

bool RenderJob::has_room(Rank helper, Rank owner) const {
  return held_bytes_[helper.value] + slice_bytes_[owner.value] <= scene_.copy_room;
}

bool RenderJob::may_be_copied(Rank owner) const {
  for (std::uint32_t bit = 0; scene_.makes_copies && bit < cube_.dimension(); ++bit) {
    if (has_room(cube_.neighbour(owner, bit), owner)) return true;
  }
  return false;
}

const SharedBytes* RenderJob::slice_to_copy(Rank owner, Rank helper) {
  const auto bit = cube_.link_between(helper, owner);
  if (!scene_.makes_copies || !bit || (copies_[helper.value] >> *bit & 1) != 0) return nullptr;
  if (!has_room(helper, owner)) return nullptr;
  copies_[helper.value] |= 1u << *bit;
  held_bytes_[helper.value] += slice_bytes_[owner.value];
  return &scene_.slices[owner.value];
}

control::Load RenderJob::load() const {
  control::Load m;
  m.job = job_;
  m.epoch = epoch_;
  m.algorithm = scene_.algorithm;
  m.threads = threads_;
  m.grid = scene_.grid;
  m.grain = scene_.grain;
  m.tile_size = kTileSide;
  m.shadows = scene_.shadows;
  m.flow = scene_.flow;
  m.queue = scene_.queue;
  m.horizon_bytes = scene_.horizon_bytes;
  m.borrow_bytes = lends() ? kBorrowBytes : 0;
  m.is_replica = scene_.has_replicas;
  m.makes_copies = scene_.makes_copies;
  m.sums = sums_;
  m.link_credit_bytes = limits_.link_credit_bytes;
  m.window_tiles = is_roth() ? window(ledger_.tile_count()) : most_open_tiles();
  m.batch_bytes = limits_.batch_bytes;
  const std::uint64_t classes =
      most_hops(scene_.settings.max_depth, scene_.grid.columns, scene_.grid.rows);
  // Classes beyond the last would share its places and could wait for themselves.
  if (classes < kMaxHops) m.outbox_rays = limits_.outbox_rays;
  m.class_places = static_cast<std::uint32_t>(std::max<std::uint64_t>(
      1, limits_.outbox_rays / (4 * classes * std::max(1u, cube_.dimension()))));
  if (scene_.flow == FlowMode::kBlocking) {
    // One evaluator a node, one ray a message, and the queue's places shared out among the links.
    m.threads = 1;
    m.batch_bytes = kRayBytes;
    m.link_credit_bytes = kRayBytes * std::max(1u, scene_.queue / std::max(1u, cube_.dimension()));
  }
  return m;
}

std::uint32_t RenderJob::most_open_tiles() const {
  const ImageSize& image = scene_.settings.image;
  const double primaries =
      static_cast<double>(image.width) * image.height * image.samples * image.samples;
  const double rays_per_tile =
      scene_.rays_per_primary * primaries / static_cast<double>(ledger_.tile_count());
  const double fitting =
      rays_per_tile > 0 ? limits_.window_rays / rays_per_tile : limits_.window_tiles;
  const std::uint32_t least = std::min(limits_.least_window_tiles, limits_.window_tiles);
  return static_cast<std::uint32_t>(std::clamp<double>(fitting, least, limits_.window_tiles));
}

std::uint32_t RenderJob::window(std::size_t left) const {
  if (is_roth()) {
    const auto share =
        static_cast<std::uint32_t>(left / (std::size_t{kPartOfRothShare} * nodes_ * threads_));
    const std::uint32_t most =
        scene_.grain == Grain::kTile ? kMostRothTilesPerThread : kRothTilesPerThread;
    return std::clamp(share, kRothTilesPerThread, most) * threads_;
  }
  const std::uint32_t most = most_open_tiles();
  if (!scene_.has_replicas) return most;
  const auto part = static_cast<std::uint32_t>(left / kPartOfTilesLeft);
  return std::clamp(part, std::min(kLeastTilesPerThread * threads_, most), most);
}

void RenderJob::set_ready(Rank rank) {
  if (ready_[rank.value]) return;
  ready_[rank.value] = true;
  ++ready_count_;
}

std::vector<std::uint32_t> RenderJob::next_tiles(Rank rank) {
  std::vector<std::uint32_t> tiles;
  std::uint32_t& open = open_[rank.value];
  if (is_roth()) {
    while (next_tile_ < ledger_.tile_count() && open < window(ledger_.tile_count() - next_tile_)) {
      tiles.push_back(next_tile_++);
      ++open;
    }
  } else {
    auto& own = own_tiles_[rank.value];
    // Many at a time: a message for each tile that becomes whole would wake a node for next to
    // nothing.
    const std::uint32_t most = window(own.size());
    if (!scene_.has_replicas && most - std::min(open, most) < most / kPartOfWindow) return tiles;
    while (!own.empty() && open < window(own.size())) {
      tiles.push_back(own.front());
      own.pop_front();
      ++open;
    }
    while (own.empty()) {
      auto* theirs = tiles_to_take_over(rank);
      if (theirs == nullptr || theirs->empty() || open >= window(theirs->size())) break;
      // From the far end: the owner comes from the other.
      tiles.push_back(theirs->back());
      theirs->pop_back();
      ++open;
    }
  }
  for (const std::uint32_t tile : tiles) holder_[tile] = rank;
  return tiles;
}

std::deque<std::uint32_t>* RenderJob::tiles_to_take_over(Rank helper) {
  if (!scene_.has_replicas) return nullptr;
  std::deque<std::uint32_t>* most = nullptr;
  for (std::uint32_t bit = 0; bit < cube_.dimension(); ++bit) {
    auto& theirs = own_tiles_[cube_.neighbour(helper, bit).value];
    if (most == nullptr || theirs.size() > most->size()) most = &theirs;
  }
  return most;
}

Rank RenderJob::owner_of(std::uint32_t tile) const {
  const RegionIndex owner = scene_.plan->owner_of_tile(tile);
  return cube_.owner_of(owner.column, owner.row);
}

std::vector<std::uint32_t> RenderJob::take_relief() {
  return std::exchange(relief_, std::vector<std::uint32_t>(nodes_, 0));
}

std::string RenderJob::add_contributions(std::span<const std::byte> batch,
                                         std::vector<Rank>& opened) {
  BatchLimits limits;
  limits.pixel_count = (1 + kAovPlanes) * film_.pixel_count();
  limits.tile_count = static_cast<std::uint32_t>(ledger_.tile_count());
  limits.max_depth = scene_.settings.max_depth;
  limits.nodes = nodes_;
  const auto result = decode_contributions(batch, limits, credits_, contributions_);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    return "a broken batch of contributions: " + std::string(to_string(*error));
  }
  const BatchStamp& s = std::get<BatchHeader>(result).stamp;
  if (!is_meant(s)) return {};
  if (s.sender >= nodes_ || s.sequence != batches_received_[s.sender]) {
    return "a batch of contributions from node " + std::to_string(s.sender) + " was lost";
  }
  ++batches_received_[s.sender];
  for (const Contribution& c : contributions_) {
    if (c.pixel >= film_.pixel_count() && !film_.has_slot(c.pixel))
      return "a contribution to AOVs that nobody asked for";
    film_.add(c.pixel, c.light);
  }
  for (const TileCredit& c : credits_) {
    switch (ledger_.add(c.tile, c.credit)) {
      case CreditResult::kOpen: break;
      case CreditResult::kWhole:
        --open_[holder_[c.tile].value];
        opened.push_back(holder_[c.tile]);
        if (!is_roth() && holder_[c.tile] != owner_of(c.tile)) ++relief_[owner_of(c.tile).value];
        break;
      case CreditResult::kOverflow:
      case CreditResult::kUnknownTile:
        return "tile " + std::to_string(c.tile) + " got back more credit than it gave out";
    }
  }
  return {};
}

bool RenderJob::all_batches_in() const {
  return verdict_ && std::accumulate(batches_received_.begin(), batches_received_.end(),
                                     std::uint64_t{0}) == verdict_->contribution_batches;
}

bool RenderJob::is_complete() const {
  return ledger_.all_whole() && (is_roth() || all_batches_in());
}

std::string RenderJob::contradiction() const {
  if (is_roth() || !all_batches_in() || ledger_.all_whole()) return {};
  return "internal error: the token found nothing left, but " +
         std::to_string(ledger_.tile_count() - ledger_.whole_count()) + " tiles are open";
}

void RenderJob::set_report(const control::NodeReport& report) {
  const std::uint32_t rank = report.stats.rank;
  if (rank >= nodes_ || reported_[rank]) return;
  reported_[rank] = true;
  ++report_count_;
  reports_[rank] = report.stats;
}

}  // namespace graycube
