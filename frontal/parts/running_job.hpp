// The job that is on: how far it is, and its messages to and from the nodes.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frontal/parts/farm_log.hpp"
#include "frontal/parts/frontal_options.hpp"
#include "frontal/parts/job_queue.hpp"
#include "frontal/parts/post.hpp"
#include "frontal/parts/tile_log.hpp"
#include "frontal/rendering/deadlock_watch.hpp"
#include "frontal/rendering/render_job.hpp"
#include "frontal/rendering/standstill_watch.hpp"
#include "proto/statistics.hpp"

namespace graycube {

/// Seconds for which a deadlocked job waits for its nodes' reports.
inline constexpr double kReportPatience_s = 5;

/// The stages of a job, in the order in which it goes through them.
enum class JobStage : std::uint8_t {
  kPreparing,  ///< its scene is read and cut
  kPrepared,   ///< it can be loaded once all nodes are here
  kBuilding,   ///< nodes subdivide their slices, or drop what an epoch has left
  kRendering,  ///< all nodes are ready and have been told to trace
  kReporting,  ///< nothing more will be traced; the nodes' reports are due
};

/// A node that is lost.
struct NodeLoss {
  Rank rank;
  /// For people: its name, and how it was lost.
  std::string name, how;
  /// Seconds since it was last heard.
  double noticed_s = 0;
};

/// Why a job ends without a picture.
struct JobFailure {
  JobState state = JobState::kFailed;
  FailureCode code = FailureCode::kFailed;
  std::vector<control::ErrorItem> errors;
};

class RunningJob {
 public:
  /// `farm` and `log` must outlive the job.
  RunningJob(const FrontalOptions& farm, const QueuedJob& job, const Moment& now,
             const CpuMeter& cpu, FarmLog& log);

  std::uint32_t id() const { return info_.job; }
  JobStage stage() const { return stage_; }
  /// Whether the nodes know of the job.
  bool is_loaded() const { return stage_ >= JobStage::kBuilding; }
  bool is_prepared() const { return render_.has_value(); }
  bool is_overdue(double now_s) const;

  void prepared(PreparedScene scene);
  /// Once it is prepared: goes on with the picture where these records of tiles, if there are any,
  /// end. False if they are of another picture; then they are to be forgotten.
  [[nodiscard]] bool resume(std::span<const std::byte> records);
  /// Records of tiles that have become whole, in pieces; empty when none are due. `all`: whenever
  /// the last ones were made.
  Bytes take_records(double now_s, bool all);
  /// Sends their slices to the nodes that need them, once all nodes are here.
  void load(double now_s, Post& post);
  bool waits_to_be_loaded() const;
  /// Where slices come over links: sends them to rank 0, once all nodes know of the job.
  void on_epoch_ack(Rank rank, const control::EpochAck& m, Post& post);
  void on_ready(Rank rank, const control::Ready& m);
  /// Whether nodes are ready and wait to be told to trace.
  bool can_start() const;
  void start(std::vector<std::uint32_t> incarnations, double now_s, Post& post);

  /// So many frontals have begun this job and ended before it did.
  void goes_on_after(std::uint32_t frontals);

  // Losses. The job goes on in another epoch, unless a failure is returned.
  /// The nodes of a process are lost; other processes take their places.
  [[nodiscard]] std::optional<JobFailure> lose(const std::vector<NodeLoss>& nodes, Post& post);
  /// A node whose loss is known has got a place in another one's process; `how` tells that.
  void note_guest(const NodeLoss& node);
  [[nodiscard]] std::optional<JobFailure> on_error(Rank rank, const control::NodeError& m,
                                                   Post& post);
  void on_pong(Rank rank, const control::Pong& m, double now_s) {
    if (is_rendering()) standstill_watch_.on_pong(rank, m, now_s);
  }
  /// A node that answers but doesn't get on, and may be taken for lost.
  std::optional<Rank> standing_still(double now_s) const {
    if (!is_rendering()) return std::nullopt;
    return standstill_watch_.standing_still(now_s, farm_.standstill_s);
  }
  [[nodiscard]] std::optional<JobFailure> look_for_lost_messages(double now_s, Post& post);

  // Messages of the nodes while the job is rendered. A failure that is returned ends the job.
  [[nodiscard]] std::optional<JobFailure> on_light(Rank from, std::span<const std::byte> batch,
                                                   Post& post);
  void on_borrow(Rank rank, const control::Borrow& m, Post& post) const;
  void on_share(Rank owner, const control::Share& m, Post& post);
  /// False when the token is of another job or epoch.
  [[nodiscard]] bool on_round(const control::TokenRound& m);
  void on_terminated(const control::Terminated& m);
  /// `last_ping`: the sequence of the newest ping that was sent.
  void on_wait_report(Rank rank, const control::WaitReport& m, std::uint64_t last_ping,
                      double now_s, Post& post);
  void on_worked(Rank rank, const control::Worked& m, Post& post);
  /// The node holds the next generation of the grid, to which boundaries slide.
  void on_slid(Rank rank, const control::Slid& m, double now_s, Post& post);
  /// Where boundaries slide, to be called after tiles have become whole or have been begun: decides
  /// whether they slide now, and tells nodes which generations of the grid are over.
  void look_at_boundaries(double now_s, Post& post);
  /// What is to be cut anew for a slide, if there is something.
  std::optional<RecutWork> take_recut();
  [[nodiscard]] std::optional<JobFailure> on_recut(const RecutResult& cut, Post& post);
  /// Asks the nodes for reports once all light is here; fails if that and the token contradict each
  /// other.
  [[nodiscard]] std::optional<JobFailure> finish_when_complete(double now_s, Post& post);
  void on_report(const control::NodeReport& m);
  /// Whether all nodes have reported that will.
  bool is_over() const;

  /// The cycle of nodes that wait for each other, once one was found: then the job can only end
  /// with this, whatever else happens while it waits for reports.
  const std::optional<JobFailure>& deadlock() const { return deadlock_; }
  /// Whether reports after a deadlock are not waited for any longer.
  bool has_lost_patience(double now_s) const;

  /// The job's record to be kept; it makes no guess at when the job ends.
  control::JobInfo info() const;
  control::JobInfo info_at(double now_s) const;
  control::Progress progress_at(double now_s) const;
  /// Tiles that have become whole under this frontal.
  std::uint32_t tiles_made() const { return info_.tiles_whole - resumed_tiles_; }
  /// What nodes have reported, and the bytes of the slices that the frontal sent. Once it is
  /// prepared.
  const std::vector<control::NodeStats>& node_stats() const { return render_->reports().stats(); }
  std::uint64_t slice_bytes() const { return render_->slices().own_bytes(); }
  /// The film, when the job is over.
  Film take_film() { return render_->take_film(); }
  /// The statistics file; `failed`: why there is no picture, or empty.
  std::string statistics(double now_s, const CpuMeter& cpu, const std::string& failed) const;

 private:
  bool is_rendering() const { return stage_ == JobStage::kRendering; }
  bool is_on_nodes() const { return stage_ == JobStage::kBuilding || is_rendering(); }
  struct NamedLoss {
    /// For people: who is lost, or has missed something.
    std::string name;
    Loss loss;
  };
  std::optional<JobFailure> go_on_without(std::vector<NamedLoss> losses, bool are_gone, Post& post);
  Sliding* sliding() { return is_rendering() ? render_->sliding() : nullptr; }
  /// Epochs so far, those of earlier frontals too.
  std::uint32_t epochs() const { return render_->epoch() + 1 + earlier_frontals_; }
  void hand_out(Rank rank, Post& post);
  /// What its records are of.
  RecordedPicture recorded_picture() const;
  void ask_for_reports(double now_s, Post& post);

  struct Times {
    double submitted_s = 0, began_s = 0, build_began_s = 0, render_began_s = 0, render_ended_s = 0;
  };
  struct CpuBefore {
    double used_s = 0, starting_s = 0;
  };

  const FrontalOptions& farm_;
  FarmLog& farm_log_;
  /// Digest of what was submitted.
  std::uint64_t content_;
  control::JobInfo info_;
  control::JobOptions options_;
  JobStage stage_ = JobStage::kPreparing;
  Times times_;
  /// CPU seconds before the job; 0 for the first job, as all that came before was for its sake.
  CpuBefore cpu_before_;
  std::optional<RenderJob> render_;
  StandstillWatch standstill_watch_;
  std::vector<Loss> losses_;
  /// Frontals that had begun this job.
  std::uint32_t earlier_frontals_ = 0;
  TileLog log_;
  /// Whether there are records of this picture already.
  bool has_records_ = false;
  std::uint32_t resumed_tiles_ = 0;
  /// All tiles were whole when a node was lost: nobody waits for the token's verdict.
  bool is_cut_short_ = false;
  /// Nodes that have become ready while others trace.
  std::vector<Rank> late_;
  /// Whether nodes were told that no more tiles will come, where boundaries slide.
  bool are_told_dealt_ = false;
  std::optional<DeadlockWatch> deadlock_watch_;
  std::optional<JobFailure> deadlock_;
};

/// The progress of a job that isn't running.
control::Progress progress_of(const control::JobInfo& info);

}  // namespace graycube
