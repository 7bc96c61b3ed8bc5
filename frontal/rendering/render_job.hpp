// A job while it is on the nodes: which node has which slice and which tiles, the light that has
// come, what the token found, and the nodes' reports.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontal/preparation/preparation.hpp"
#include "frontal/rendering/barrier.hpp"
#include "frontal/rendering/flow_limits.hpp"
#include "frontal/rendering/light_intake.hpp"
#include "frontal/rendering/node_reports.hpp"
#include "frontal/rendering/roll_call.hpp"
#include "frontal/rendering/slice_stock.hpp"
#include "frontal/rendering/sliding.hpp"
#include "frontal/rendering/tile_handout.hpp"
#include "topology/slice_way.hpp"

namespace graycube {

/// Bytes that other nodes' models may take on a node with `--shadows local`.
inline constexpr std::uint64_t kBorrowBytes = std::uint64_t{256} << 20;

class RenderJob {
 public:
  RenderJob(std::uint32_t job, PreparedScene scene, const Hypercube& cube, std::uint32_t threads,
            const FlowLimits& limits = {}, SumsMode sums = SumsMode::kDirect,
            std::uint32_t retries = kDefaultRetries);
  /// Not copyable, as its parts refer to the plan of its scene.
  RenderJob(const RenderJob&) = delete;
  RenderJob& operator=(const RenderJob&) = delete;

  std::uint32_t id() const { return job_; }
  std::uint32_t epoch() const { return epoch_; }
  /// Whether a node's message is about this job and epoch.
  bool is_meant(const auto& message) const {
    return message.job == job_ && message.epoch == epoch_;
  }
  const PreparedScene& scene() const { return scene_; }
  SumsMode sums() const { return sums_; }
  std::uint32_t threads() const { return threads_; }
  bool is_roth() const { return scene_.algorithm == Algorithm::kRoth; }
  control::Load load() const;
  SliceStock& slices() { return slices_; }
  const SliceStock& slices() const { return slices_; }

  /// The way on which slices come over links; nothing if each node gets its slice from the frontal.
  std::optional<SpanningTree> slice_way() const { return graycube::slice_way(cube_, scene_.mesh); }
  /// Notes that a node knows of the job; true for the last one.
  [[nodiscard]] bool knows_of_it(Rank rank) { return loaded_.note(rank) && loaded_.is_complete(); }
  /// Which nodes can trace.
  Barrier& barrier() { return barrier_; }
  void is_ready(Rank rank, std::uint32_t epoch) {
    barrier_.is_ready(rank, epoch);
    retries_.can_trace(rank);
  }
  const Barrier& barrier() const { return barrier_; }

  /// How much of the job a loss concerns.
  struct Damage {
    /// Tiles that were under way, and are to be traced again.
    std::uint32_t tiles = 0;
    /// For people, if it has happened too often: what may be to blame.
    std::string culprit;
  };
  /// The nodes, which share a process, are lost; or, if they aren't gone, have told of a loss.
  /// Without nodes, nobody knows where something was lost.
  [[nodiscard]] Damage note_loss(std::span<const Rank> nodes, bool are_gone);
  /// Begins the next epoch: tiles that are not whole are to be traced again.
  void begin_next_epoch();
  /// Whether all nodes are loaded anew in a later epoch, since slices go from node to node, or
  /// boundaries have slid.
  bool loads_all_again() const { return sliding_ || slice_way(); }
  /// How many of each node's tiles are to be traced, by rank; empty if nodes know it.
  std::vector<std::uint32_t> open_tiles() const;

  /// Before the job is loaded: takes up tiles of which there are records. Returns how many. Where
  /// boundaries slide none are, since those who decide on slides go by what tiles have cost.
  std::uint32_t restore(std::span<const std::byte> records);
  /// Tiles to hand to a node now.
  std::vector<std::uint32_t> next_tiles(Rank rank);
  /// Null unless boundaries slide.
  Sliding* sliding() { return sliding_ ? &*sliding_ : nullptr; }
  const Sliding* sliding() const { return sliding_ ? &*sliding_ : nullptr; }
  /// Boundaries have slid: tiles that are left have other owners.
  void deal() { tiles_.deal(sliding_->owners()); }
  std::uint64_t next_assignment_sequence(Rank rank) { return tiles_.next_sequence(rank); }
  /// Takes in a batch of contributions. The nodes whose windows opened are appended to `opened`.
  LightIntake::Taken add_contributions(std::span<const std::byte> batch, std::vector<Rank>& opened);
  /// How many of each node's tiles neighbours made whole since the last call, indexed by rank.
  std::vector<std::uint32_t> take_relief() { return tiles_.take_relief(); }

  void set_terminated(const control::Terminated& verdict) { verdict_ = verdict; }
  /// Tells the rounds and hops of the token so far.
  void set_token(const control::TokenProgress& token) { token_ = token; }
  const control::TokenProgress& token() const { return token_; }
  std::size_t tiles() const { return light_.tiles().tile_count(); }
  std::size_t tiles_whole() const { return light_.tiles().whole_count(); }
  bool film_is_complete() const { return light_.tiles().all_whole(); }
  bool is_complete() const;
  /// The error when the token says that nothing is left to do but a tile is open; empty if all is
  /// well.
  std::string contradiction() const;
  const Film& film() const { return light_.film(); }
  /// The film, when the job is over.
  Film take_film() { return light_.take_film(); }

  NodeReports& reports() { return reports_; }
  const NodeReports& reports() const { return reports_; }

 private:
  /// Whether nodes may ask for each other's slices.
  bool lends() const {
    return !is_roth() && scene_.shadows == ShadowMode::kLocal && !scene_.has_replicas;
  }
  bool all_batches_in() const {
    return verdict_ && light_.batches() == verdict_->contribution_batches;
  }
  /// Whether nodes send each other anything, so that none can do without the others.
  bool has_links() const { return !is_roth() || sums_ != SumsMode::kDirect; }
  TileHandout::Way way() const;
  std::string culprit(std::uint32_t tile) const;
  void set_class_places(control::Load& m) const;

  std::uint32_t job_;
  std::uint32_t epoch_ = 0;
  PreparedScene scene_;
  Hypercube cube_;
  std::uint32_t threads_;
  FlowLimits limits_;
  SumsMode sums_;
  SliceStock slices_;
  LightIntake light_;
  Retries retries_;
  TileHandout tiles_;
  std::optional<Sliding> sliding_;
  RollCall loaded_;
  Barrier barrier_;
  NodeReports reports_;
  std::optional<control::Terminated> verdict_;
  control::TokenProgress token_;
};

}  // namespace graycube
