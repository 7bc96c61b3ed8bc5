// A farm in one process: the real brains of frontal and nodes, wired on a simulated machine. Only
// the machine says how long anything takes, so that a run replays exactly: from a seed in the
// tests, from costs per unit in `graycube simulate`.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontal/frontal.hpp"
#include "node/node.hpp"
#include "node/parts/class_places.hpp"
#include "node/parts/fifo/ray_fifo.hpp"
#include "node/wait_clock.hpp"
#include "proto/control.hpp"
#include "simulation/cores.hpp"
#include "simulation/machine.hpp"
#include "simulation/timeline.hpp"

namespace graycube::simulation {

struct FarmOptions {
  std::uint32_t nodes = 8;
  std::uint32_t threads = 1;
  double heartbeat_s = 1;
  /// A node that says nothing for so long is taken for dead.
  double silence_s = 1e12;
  std::uint32_t retries = kDefaultRetries;
  /// A job that takes longer than this in simulated time has stalled.
  double stalled_s = 600;
  FlowLimits limits{};
  /// Models of more bytes are not replicated.
  std::uint64_t replica_bytes = kReplicaBytes;
  /// What the frontal is told of; where nodes lie is the machine's affair.
  std::uint32_t hosts = 1;
};

/// Something that goes wrong while a job is rendered.
struct Fault {
  enum class Kind : std::uint8_t {
    kDeath,         ///< the node's process ends
    kStop,          ///< the node does nothing any more, and nobody is told
    kCut,           ///< for `lasts_s` seconds nothing gets from `rank` to `to`
    kNoMoreStarts,  ///< from then on no process can be started; `rank` means nothing
  };
  Kind kind = Kind::kDeath;
  Rank rank;
  /// Simulated seconds after the render begins.
  double after_s = 0;
  /// kCut: where the link leads; nothing for the frontal.
  Place to{};
  double lasts_s = 0;
};

/// The result of a job, and what was seen on the way.
struct Outcome {
  bool ended = false;
  std::optional<control::Done> done;
  std::optional<control::Failed> failed;
  std::uint32_t rounds = 0;
  /// Epochs of the job.
  std::uint32_t epochs = 0;
  /// Broken promises, in words; empty when all held.
  std::vector<std::string> violations;
  /// The nodes' reports, indexed by rank, also of a job that failed; empty if none were asked for.
  std::vector<control::NodeStats> reports;
  /// Rays that were sent on the credit of their classes.
  std::uint64_t class_rays = 0;
  /// Simulated seconds from the barrier to the end, or to the last thing that any process did
  /// before a failure.
  double render_s = 0;
  /// Simulated seconds from when the job was submitted to the barrier: slices on their way.
  double distribution_s = 0;
  /// CPU seconds that reading and cutting the scene took here; it takes no simulated time.
  double preparation_cpu_s = 0;
};

class Farm {
 public:
  /// The machine must outlive the farm.
  Farm(const FarmOptions& options, Machine& machine);

  /// Renders a scene; the picture is then in store().
  Outcome render(const std::string& scene_text, const control::JobOptions& options);
  JobStore& store() { return *store_; }
  /// How many nodes each process is; in no order.
  std::vector<std::size_t> nodes_by_process() const;
  /// Why the farm gave up; empty when it did not.
  const std::string& fatal_error() const { return frontal_->fatal_error(); }
  /// Will happen in the next render.
  void will_happen(const Fault& fault) { faults_.push_back(fault); }

  /// Called with the work that a brain or evaluator did, and the CPU seconds that it took on this
  /// machine. If it isn't set, nothing is measured.
  std::function<void(const PerUnit&, double)> observe;
  /// Called with each message between nodes, or between a node and the frontal, when it is sent.
  std::function<void(Place from, Place to, double sent_s, const Message&)> on_sent;

 private:
  struct Process {
    std::unique_ptr<Node> node;
    std::unique_ptr<Workbench> bench = std::make_unique<Workbench>();
    std::uint32_t incarnation = 0;
    /// Nodes with the same number share a process, and end together. Each has cores of its own all
    /// the same.
    std::uint64_t pid = 0;
    /// Evaluators that wait for a core or work, and pieces of work that are under way.
    unsigned active = 0, working = 0;
    double cpu_s = 0, busy_s = 0, last_primary_s = 0;
    /// The node's FIFO, if it is a process apart, what it serves, and its part of cpu_s.
    std::optional<RayFifo> fifo;
    std::optional<FifoOrder> fifo_order;
    double fifo_cpu_s = 0;
    WaitClock clock;
    WaitReason reason = WaitReason::kIdle;
    unsigned waiting = 0;
    bool is_rendering = false;
    /// For each bit, bytes of rays sent across that link for which no credit has come back.
    std::vector<std::uint64_t> unreturned;
    /// For each bit, the class places that rays sent across that link have taken.
    std::vector<ClassPlaces> places_out;
  };

  Cores& cores_of(Place place);
  std::uint32_t process_of(Place place) const { return place ? place->value : cube_.nodes(); }
  Thread& mailroom_of(Place place) { return *mailrooms_[process_of(place)]; }
  double take(Place place, const PerUnit& doings);
  PerUnit passing(Place from, Place to, std::size_t bytes) const;
  Place place_of(const PeerId& peer) const;

  // The frontal
  void start(const Frontal::Process& started);
  void run_node(const Frontal::Process& started, std::uint64_t pid);
  void tick(unsigned render);
  template <typename Call>
  void in_frontal(PerUnit doings, Call&& call);
  void frontal_receives(const PeerId& peer, const Message& message);
  void prepare(const PreparationWork& work);
  void recut(const RecutWork& work);
  void in_frontals_background(double seconds, std::function<void()> call);
  void deliver(const Frontal::Outgoing& o);
  void on_client_message(const Message& message);

  // The nodes
  template <typename Call>
  void in_node(Rank rank, bool is_evaluator, PerUnit doings, Call&& call);
  void node_receives(Rank rank, std::uint32_t incarnation, Place from, const Message& message);
  void deliver(Rank rank, const Node::Outgoing& o);
  void wake(Rank rank);

  // The FIFOs that are processes apart
  void serve_fifo(Process& p);
  void deliver_to_fifo(Rank rank, const FifoOrder& order, const std::vector<Bytes>& messages);
  void fifo_receives(Rank rank, std::uint32_t incarnation, const FifoOrder& order,
                     const Bytes& message);
  double run_fifo(Rank rank, const Bytes& message, Bytes& answer);
  void node_receives_ray(Rank rank, std::uint32_t incarnation, const Bytes& answer);

  // Evaluators
  void ask_for_turn(Rank rank, bool is_woken);
  struct Turn;
  double begin(Turn& turn);
  void end(Turn& turn);
  void happen(const Fault& fault);
  void kill(const Frontal::Process& process);
  std::vector<Frontal::Process> end_process(std::uint64_t pid);
  void fail_to_start(const Frontal::Process& process);
  void tell_of_end(const Frontal::Process& process, bool was_started);
  bool is_cut(Rank from, Place to) const;
  void collect_reports();

  // The watch over promises and time
  void watch_time(Process& p);
  void fill_in(Process& p, control::NodeStats& stats);
  void watch_to_node(const Message& message);
  void watch_epoch(std::uint32_t epoch);
  void watch_to_frontal(const Message& message);
  void watch_batch(Rank from, Rank to, const Bytes& batch, bool is_sent);
  void watch_classes(Rank from, Rank to, const Bytes& batch, BatchType type, bool is_sent);
  void check_quiet();
  bool is_alive(Rank rank, std::uint32_t incarnation) const;

  FarmOptions options_;
  Machine& machine_;
  Hypercube cube_;
  Timeline timeline_;
  std::vector<std::unique_ptr<Cores>> cores_;       // by rank, then the frontal's; or one for all
  std::vector<std::unique_ptr<Thread>> mailrooms_;  // by rank, then the frontal's
  std::vector<std::unique_ptr<Thread>> fifos_;      // by rank
  std::unique_ptr<JobStore> store_ = make_memory_store();
  std::unique_ptr<Frontal> frontal_;
  double frontal_cpu_s_ = 0;
  std::vector<Process> processes_;
  std::map<PeerId, Rank> peers_;
  /// Numbers of batches under way: of rays, and of light between nodes.
  std::int64_t rays_under_way_ = 0, sums_under_way_ = 0;
  /// Whether the token has found the end; and whether nodes were told to report without that.
  bool is_over_ = false, has_failed_ = false;
  std::vector<Fault> faults_;
  bool can_start_ = true;
  /// Until when links are cut.
  std::map<std::pair<Rank, Place>, double> cut_until_s_;
  double render_began_s_ = 0, last_change_s_ = 0;
  /// The message that loaded the running job, and the job's epoch.
  control::Load load_;
  std::uint32_t epoch_ = 0;
  unsigned renders_ = 0;
  std::uint32_t reports_ = 0;
  Outcome outcome_;
};

}  // namespace graycube::simulation
