// The jobs of a farm: the one that is on, those that wait for it and those that have ended; what
// clients may ask of them, and who is told when a job gets on or ends.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "frontal/admission/admission.hpp"
#include "frontal/parts/ended_jobs.hpp"
#include "frontal/parts/farm_log.hpp"
#include "frontal/parts/frontal_options.hpp"
#include "frontal/parts/job_queue.hpp"
#include "frontal/parts/picture_keeping.hpp"
#include "frontal/parts/post.hpp"
#include "frontal/parts/progress_watch.hpp"
#include "frontal/parts/running_job.hpp"
#include "frontal/parts/watchers.hpp"
#include "frontal/parts/writing.hpp"

namespace graycube {

class Jobs {
 public:
  /// All that is given must outlive this.
  Jobs(const FrontalOptions& farm, JobStore& store, Post& post, FarmLog& log);
  void set_cpu_meter(CpuMeter meter) { cpu_ = std::move(meter); }

  /// Sets the time that all other calls use, until it is set again.
  void set_time(const Moment& now) { now_ = now; }
  /// Ends the job that is on if it is out of time; tells of its progress now and then.
  void check_time();
  /// Jobs that wait, and those that are on and have ended and are listed.
  void count(control::FarmInfo& farm) const;
  /// What the farm has counted, what is on included, and how far that is.
  void count(control::FarmMetrics& farm) const;

  // Asked by clients
  /// Nothing if the answer is posted later.
  std::optional<Answer> submit(Submission submission) {
    return admission_.submit(std::move(submission), now_);
  }
  Answer status(std::uint32_t job) const;
  Answer list() const;
  Answer watch(const PeerId& peer, std::uint32_t job);
  Answer cancel(std::uint32_t job);
  Answer fetch(const control::Fetch& m);
  /// The writing that is asked for, for which nobody is named yet, or why it isn't done.
  std::variant<WritingWork, Refusal> write(const control::Write& m);

  /// The long scene that is to be taken into the store, once one is submitted.
  std::optional<AdmissionWork> take_admission() { return admission_.take_work(now_, post_); }
  void give_result(const AdmissionResult& result) { admission_.give_result(result, now_, post_); }
  bool is_admitting() const { return admission_.is_at_work(); }
  /// The picture that is to be kept, once a job is complete. It counts as rendered until the result
  /// is given, and no other job is on.
  std::optional<KeepingWork> take_keeping() { return keeping_.take_work(store_); }
  void give_result(KeepingResult result);
  bool is_keeping() const { return keeping_.is_on(); }
  /// Whether the job's picture has to be read before it can be fetched.
  bool must_read(std::uint32_t job) const;
  ReadingWork reading(std::uint32_t job) { return {job, &store_}; }
  void give_result(ReadingResult result);

  /// The preparation of the next job, once none is on.
  std::optional<PreparationWork> take_work();
  void give_result(PreparationResult result);
  /// The cutting that a slide of the boundaries needs, if one was decided.
  std::optional<RecutWork> take_recut() { return running_ ? running_->take_recut() : std::nullopt; }
  void give_result(const RecutResult& cut);
  /// Whether the job that is on waits for all nodes to be here; then load() loads it.
  bool waits_to_be_loaded() const { return running_ && running_->waits_to_be_loaded(); }
  void load();
  /// The job that is on, for which alone it is worth to prepare or to cut anything.
  std::optional<std::uint32_t> job_that_is_on() const {
    return running_ ? std::optional(running_->id()) : std::nullopt;
  }
  /// Whether nodes work on a job.
  bool keep_nodes_busy() const { return running_ && running_->is_loaded(); }

  // Told by nodes
  void on_light(Rank from, std::span<const std::byte> batch);
  /// Whether nodes are ready and wait to be told to trace.
  bool can_start() const { return running_ && running_->can_start(); }
  /// `incarnations`: the nodes' start numbers, indexed by rank.
  void start(std::vector<std::uint32_t> incarnations);
  void on_node(Rank rank, const control::Ready& m);
  void on_node(Rank rank, const control::Pong& m);
  void on_node(Rank rank, const control::EpochAck& m);
  void on_node(Rank rank, const control::TokenRound& m);
  void on_node(Rank rank, const control::Terminated& m);
  void on_node(Rank rank, const control::NodeReport& m);
  void on_node(Rank rank, const control::NodeError& m);
  void on_node(Rank rank, const control::Borrow& m);
  void on_node(Rank rank, const control::Share& m);
  void on_node(Rank rank, const control::Worked& m);
  void on_node(Rank rank, const control::Slid& m);
  /// `last_ping`: the sequence of the newest ping that was sent.
  void on_wait_report(Rank rank, const control::WaitReport& m, std::uint64_t last_ping);

  /// Tells that a check failed, or an exception came, while the running job was worked on: that job
  /// fails. Without a job that is on, false.
  [[nodiscard]] bool fail_internally(const std::string& why);
  /// A node that answers but doesn't get on, and may be taken for lost.
  std::optional<Rank> standing_still() const {
    return running_ ? running_->standing_still(now_.now_s) : std::nullopt;
  }
  /// The job that is on begins another epoch if its nodes wait for what never comes.
  void look_for_lost_messages();
  /// Tells that the nodes of a process are lost: a job that they had goes on in another epoch.
  void nodes_were_lost(const std::vector<NodeLoss>& nodes);
  /// Tells that a lost node has got a place in another one's process.
  void node_has_host(const NodeLoss& node);
  /// Stops every job, as the farm stops: cancels them, or leaves them to the next frontal.
  void stop();

 private:
  void recover_accepted();
  void find_scene(PreparationWork& work);
  void resume();
  void record_tiles(bool all);
  bool is_rendered() const { return running_ && running_->is_prepared(); }
  std::optional<control::JobInfo> find(std::uint32_t job) const;
  /// The running job, with what it waits for as its message; one must be on.
  control::JobInfo running_info() const;
  /// The same for a job of the queue.
  control::JobInfo queued_info(control::JobInfo job) const;
  /// The picture of a job that is done.
  std::variant<const Picture*, Refusal> picture(std::uint32_t job);
  void tell_progress();
  void finish_when_complete();
  void end_when_over();
  void complete();
  /// Ends the job that is on without a picture.
  void fail(JobFailure failure);
  /// Keeps a job that has no picture, and tells those who watch it.
  void end(EndedJob job, JobFailure failure);
  void leave_to_next_frontal();
  /// The statistics of the job that is on, whose figures the farm takes to its own.
  std::string take_statistics(const std::string& failed);

  const FrontalOptions& farm_;
  JobStore& store_;
  Post& post_;
  FarmLog& log_;
  Moment now_;
  /// When it was last looked how far the job is, and when old jobs were cleared.
  double looked_s_ = 0, cleared_s_ = 0;
  CpuMeter cpu_;
  JobQueue queue_;
  Admission admission_{farm_, store_, queue_, log_};
  std::optional<RunningJob> running_;
  PictureKeeping keeping_;
  EndedJobs ended_;
  Watchers watchers_;
  ProgressWatch progress_watch_;
};

}  // namespace graycube
