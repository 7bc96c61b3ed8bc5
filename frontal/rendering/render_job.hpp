// A job while it is on the nodes: tiles, credit, light, reports.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "coordination/tile_ledger.hpp"
#include "film/film.hpp"
#include "frontal/preparation/preparation.hpp"
#include "proto/batch.hpp"

namespace graycube {

/// What bounds the rays in the machine; other values are for tests.
struct FlowLimits {
  /// Own tiles that a node may have open at a time in `macro`: open until the frontal holds all
  /// their light. All rays in the machine descend from them (design section 10).
  std::uint32_t window_tiles = 256;
  /// Fewer tiles where so many rays descend from them, as far as the pre-render tells, but not
  /// fewer than the least.
  double window_rays = 300'000;
  std::uint32_t least_window_tiles = 8;
  /// What may be under way on a link and in its receiver's inbox.
  std::uint64_t link_credit_bytes = std::uint64_t{2} << 20;
  std::uint32_t batch_bytes = std::uint32_t{256} << 10;
  /// What a node's outboxes may hold: then it traces only what comes on class credit. All places
  /// for such rays behind a node's links are a quarter of it, or one for each class and link.
  std::uint64_t outbox_rays = kDefaultOutboxRays;
};
/// Tiles are handed out again once this part of the window is free.
inline constexpr std::uint32_t kPartOfWindow = 4;
/// The same per evaluator thread in `roth`. Of tiles more at first, this part of an equal share of
/// those that are left, so that light comes in fewer messages; pixels and lines are handed out as
/// in 1987.
inline constexpr std::uint32_t kRothTilesPerThread = 2;
inline constexpr std::uint32_t kMostRothTilesPerThread = 16;
inline constexpr std::uint32_t kPartOfRothShare = 4;
/// Where nodes hold replicas, a node has at least so many tiles open per evaluator thread, and
/// otherwise this part of those that are left: the fewer, the more of them can still be taken over.
inline constexpr std::uint32_t kLeastTilesPerThread = 4;
inline constexpr std::uint32_t kPartOfTilesLeft = 4;
/// Shadows local: what a node may use for other nodes' models.
inline constexpr std::uint64_t kBorrowBytes = std::uint64_t{256} << 20;

class RenderJob {
 public:
  RenderJob(std::uint32_t job, PreparedScene scene, const Hypercube& cube, std::uint32_t threads,
            const FlowLimits& limits = {}, SumsMode sums = SumsMode::kDirect);

  std::uint32_t id() const { return job_; }
  std::uint32_t epoch() const { return epoch_; }
  /// Whether a node's message is about this job and epoch.
  bool is_meant(const auto& message) const {
    return message.job == job_ && message.epoch == epoch_;
  }
  const PreparedScene& scene() const { return scene_; }
  SumsMode sums() const { return sums_; }
  /// The slice for a node; given away once the node has it.
  SharedBytes take_slice(Rank rank);
  /// Shadows local: a node's slice for another node; null where there is none.
  const SharedBytes* slice_to_lend(std::uint32_t rank) const;
  /// A node's slice for a neighbour that is to help it; null where that has no room for it, or has
  /// one.
  const SharedBytes* slice_to_copy(Rank owner, Rank helper);
  control::Load load() const;

  void set_ready(Rank rank);
  bool all_ready() const { return ready_count_ == nodes_; }

  /// Tiles to hand to a node now, as its window allows: its own, and when there are none left those
  /// of the neighbour that has most, where nodes hold replicas.
  std::vector<std::uint32_t> next_tiles(Rank rank);
  /// Takes in a batch of contributions; returns what is wrong with it, or an empty string. The
  /// nodes whose windows opened are appended to `opened`.
  std::string add_contributions(std::span<const std::byte> batch, std::vector<Rank>& opened);
  /// How many of each node's tiles neighbours have traced and brought back since this was last
  /// asked.
  std::vector<std::uint32_t> take_relief();
  std::uint64_t next_assignment_sequence(Rank rank) { return assignments_sent_[rank.value]++; }

  void set_terminated(const control::Terminated& verdict) { verdict_ = verdict; }
  void set_round(std::uint32_t round, std::uint32_t hops) {
    rounds_ = round;
    hops_ = hops;
  }
  bool is_roth() const { return scene_.algorithm == Algorithm::kRoth; }
  std::uint32_t rounds() const { return rounds_; }
  std::uint32_t hops() const { return hops_; }
  std::size_t tiles() const { return ledger_.tile_count(); }
  std::size_t tiles_whole() const { return ledger_.whole_count(); }
  bool is_complete() const;
  /// What contradicts what, when the token says that nothing is left but a tile is open; else
  /// empty.
  std::string contradiction() const;

  void set_report(const control::NodeReport& report);
  bool all_reported() const { return report_count_ == nodes_; }
  /// By rank; of a node that has not reported only who it is.
  const std::vector<control::NodeStats>& reports() const { return reports_; }
  const Film& film() const { return film_; }
  std::uint32_t threads() const { return threads_; }

 private:
  /// Whether nodes may ask for each other's slices.
  bool lends() const {
    return !is_roth() && scene_.shadows == ShadowMode::kLocal && !scene_.has_replicas;
  }
  /// Whether a helper has room for a copy of the owner's slice.
  bool has_room(Rank helper, Rank owner) const;
  /// Whether any neighbour ever can have a copy of a node's slice.
  bool may_be_copied(Rank owner) const;
  bool all_batches_in() const;
  /// Tiles that a node may have open at a time in `macro`, at most.
  std::uint32_t most_open_tiles() const;
  /// The same, when so many are left of those that it takes from.
  std::uint32_t window(std::size_t left) const;
  Rank owner_of(std::uint32_t tile) const;
  /// The tiles of the neighbour that has most left, where a node that has none left may help.
  std::deque<std::uint32_t>* tiles_to_take_over(Rank helper);

  std::uint32_t job_;
  std::uint32_t epoch_ = 0;
  PreparedScene scene_;
  Hypercube cube_;
  std::uint32_t nodes_, threads_;
  FlowLimits limits_;
  SumsMode sums_;
  Film film_;
  TileLedger ledger_;
  std::vector<Rank> holder_;                          // of each tile handed out
  std::vector<std::deque<std::uint32_t>> own_tiles_;  // by rank, macro: not handed out yet
  std::vector<std::uint32_t> open_, relief_;          // by rank
  std::vector<std::uint32_t> copies_;  // by rank: bits of the neighbours whose slice it has
  std::vector<std::uint64_t> slice_bytes_,
      held_bytes_;               // by rank: of each slice; of what a node holds
  std::uint32_t next_tile_ = 0;  // roth: one queue for all
  std::vector<bool> ready_, reported_;
  std::uint32_t ready_count_ = 0, report_count_ = 0;
  std::vector<std::uint64_t> batches_received_, assignments_sent_;
  /// Of the batch that is taken in.
  std::vector<TileCredit> credits_;
  std::vector<Contribution> contributions_;
  std::optional<control::Terminated> verdict_;
  std::uint32_t rounds_ = 0, hops_ = 0;
  std::vector<control::NodeStats> reports_;
};

}  // namespace graycube
