// The frontal's brain: a state machine over nodes, clients and a queue of jobs. Messages, deaths,
// the time and results of preparation go in; messages, and requests to start or end nodes, come
// out. main.cpp wires sockets, processes and clocks on; the simulation others.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frontal/rendering/deadlock_watch.hpp"
#include "frontal/parts/job_store.hpp"
#include "frontal/preparation/preparation.hpp"
#include "frontal/rendering/render_job.hpp"
#include "transport/message.hpp"

namespace graycube {

/// A connection, as the transport names it.
using PeerId = std::string;

inline constexpr std::size_t kMaxQueuedJobs = 1000;
/// Node processes in a row that may end before their hello; then the farm gives up.
inline constexpr unsigned kMaxFailedStarts = 8;
inline constexpr std::size_t kMaxEndedJobs = kMaxJobsListed;
/// A deadlocked job waits so long for its nodes' reports.
inline constexpr double kReportPatience_s = 5;
/// Rows of a picture are sent in messages of about this size: small enough that the memory of one
/// serves the next.
inline constexpr std::size_t kPictureChunkBytes = std::size_t{1} << 20;

struct FrontalOptions {
  Hypercube cube;
  /// Evaluator threads per node.
  std::uint32_t threads = 1;
  double heartbeat_s = 1;
  /// A node that answers nothing for so long is taken for dead.
  double silence_s = 10;
  std::string version;
  /// Larger models are not replicated.
  std::uint64_t replica_bytes = kReplicaBytes;
  FlowLimits limits{};
  /// Clients may send scenes that they have compiled. Only for a client that is trusted: that a
  /// camera has a direction, and whatever else readers of scenes check, is not checked again.
  bool is_private = false;
};

class Frontal {
 public:
  struct Outgoing {
    PeerId to;
    Message message;
  };
  /// Start a process for the rank, with that start number.
  struct Spawn {
    Rank rank;
    std::uint32_t incarnation;
  };

  Frontal(FrontalOptions options, JobStore& store);

  /// Seconds on a clock that never goes back, and Unix time. Call before the events of that moment;
  /// also pings, notices silence and timeouts, and reports progress.
  void on_time(double now_s, double unix_s);
  void on_message(const PeerId& peer, const MessageView& message);
  /// A node's process has ended; `how` for people ("killed by signal 9").
  void on_node_exit(Rank rank, std::uint32_t incarnation, const std::string& how);

  /// Preparing the next job, if there is one to prepare.
  std::optional<PreparationWork> take_work();
  void give_result(PreparationResult result);

  std::vector<Outgoing> take_outgoing();
  std::vector<Spawn> take_spawns();
  /// Silent nodes, whose processes are to be ended.
  std::vector<Spawn> take_kills();
  /// After `down`: nodes have been told to stop, and so should the process, once all have left.
  bool is_going_down() const { return going_down_; }
  bool all_nodes_left() const;
  /// Why the farm gave up; empty when it did not.
  const std::string& fatal_error() const { return fatal_error_; }
  /// A client's or the operator's wish to stop.
  void go_down();

  /// CPU seconds that this process has used so far; for the statistics.
  std::function<double()> cpu_seconds = [] { return 0.0; };
  /// What of them starting processes took, this one included.
  std::function<double()> start_cpu_seconds = [] { return 0.0; };

 private:
  struct NodeRecord {
    std::uint32_t incarnation = 0;
    PeerId peer;  // empty until its hello
    std::uint64_t pid = 0;
    std::string endpoint;
    std::uint32_t threads = 1;
    double last_heard_s = 0;
    bool has_left = false;
  };
  struct QueuedJob {
    control::JobInfo info;
    PreparationWork work;
    double submitted_at_s = 0;
  };
  struct Running {
    control::JobInfo info;
    control::JobOptions options;
    double submitted_at_s = 0, began_at_s = 0, build_began_s = 0, render_began_s = 0,
           render_ended_s = 0;
    /// 0 for the first job: what came before it was for its sake.
    double cpu_at_start_s = 0, start_cpu_at_start_s = 0;
    double last_progress_s = 0;
    bool is_preparing = false;
    std::optional<RenderJob> render;
    std::optional<DeadlockWatch> deadlocks;
    /// The cycle that was found, in words; from then on the job only waits for its nodes' reports.
    std::string deadlock;
    bool is_loaded = false, is_started = false, is_finishing = false;
  };

  // frontal_clients.cpp
  void on_client(const PeerId& peer, const ControlMessage& message, const MessageView& raw);
  void on_submit(const PeerId& peer, const control::Submit& m, std::span<const std::byte> scene);
  void on_watch(const PeerId& peer, std::uint32_t job);
  void on_cancel(const PeerId& peer, std::uint32_t job);
  /// The picture of a job that is done; null, and a refusal sent, where there is none.
  const Picture* done_picture(const PeerId& peer, std::uint32_t job);
  void on_fetch(const PeerId& peer, const control::Fetch& m);
  void on_write(const PeerId& peer, const control::Write& m);
  void send_list(const PeerId& peer);
  void send_nodes(const PeerId& peer);
  std::optional<control::JobInfo> find_info(std::uint32_t job) const;
  void refuse(const PeerId& peer, std::uint32_t job, FailureCode code, std::string where,
              std::string why);
  void report_progress(bool at_once);
  control::Progress progress_of(const control::JobInfo& info) const;

  // frontal.cpp
  void on_hello(const PeerId& peer, const control::Hello& m);
  void on_node(Rank rank, const ControlMessage& message);
  std::optional<Rank> rank_of(const PeerId& peer) const;
  void lose(Rank rank, const std::string& how);
  void spawn(Rank rank);
  void welcome_all();
  bool all_nodes_here() const;
  void send(const PeerId& peer, const ControlMessage& message, SharedBytes payload = {});
  void send_to_nodes(const ControlMessage& message);

  // frontal_jobs.cpp
  void start_next_job();
  void load_when_possible();
  void start_rendering();
  void hand_out(Rank rank);
  void on_contributions(std::span<const std::byte> batch);
  void lend(Rank rank, const control::Borrow& m);
  void share(Rank owner, const control::Share& m);
  void watch_for_deadlock(Rank rank, const control::WaitReport& m);
  void end_as_deadlocked();
  void finish_when_complete();
  void complete();
  void end_job(JobState state, FailureCode code, std::vector<control::ErrorItem> errors);
  void end_queued(std::size_t index, JobState state, FailureCode code, const std::string& why);
  void keep(EndedJob job, Picture picture);
  std::string statistics(const std::string& failed = {}) const;

  FrontalOptions options_;
  JobStore& store_;
  double now_s_ = 0, unix_s_ = 0, last_ping_s_ = 0;
  std::uint64_t pings_ = 0;
  std::vector<NodeRecord> nodes_;
  std::map<PeerId, Rank> node_peers_;
  std::uint32_t next_job_ = 1, next_incarnation_ = 1;
  std::deque<QueuedJob> queue_;
  std::optional<Running> running_;
  std::deque<EndedJob> ended_;
  std::map<std::uint32_t, std::set<PeerId>> watchers_;
  std::vector<Outgoing> outgoing_;
  std::vector<Spawn> spawns_, kills_;
  unsigned failed_starts_ = 0;
  std::string fatal_error_;
  bool going_down_ = false;
};

}  // namespace graycube
