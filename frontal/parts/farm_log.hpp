// What happens on a farm, for those who run it: nodes, jobs, losses and refusals, each as an event
// with a time and a text, and counted. The process writes events out; a brain has no file.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "proto/statistics.hpp"
#include "topology/rank.hpp"
#include "transport/handshake_trouble.hpp"

namespace graycube {

struct FarmEvent {
  enum class Kind : std::uint8_t {
    kFarmIsUp,  ///< the first time that all nodes are here
    kFarmGoesDown,
    kNodeIsLost,
    kNodeHasHost,  ///< another node's process is to be a lost node, too
    kNodeIsBack,   ///< a process has taken a lost node's place
    kHostJoins,
    kHostIsLost,
    kJobAccepted,
    kJobBegins,
    kJobStands,  ///< a job hasn't got on for a while
    kJobEnds,
    kRefusal,       ///< of a submission, or of somebody who doesn't belong here
    kProcessTells,  ///< what the frontal's process knows and its brain doesn't
  };
  Kind kind{};
  /// Something that went wrong.
  bool is_trouble = false;
  double unix_s = 0;
  /// 0 where it is about none.
  std::uint32_t job = 0;
  /// For people. It may quote what clients and nodes have sent: whoever prints it must escape it.
  std::string text;
  /// Of a node's loss in a job: what the job's statistics tell of it.
  std::optional<Loss> loss;
};

/// Events that nobody takes: the oldest are dropped beyond so many.
inline constexpr std::size_t kMaxUntakenEvents = 1000;
/// Refusals that are told in a span of so many seconds; of further ones only the number is.
inline constexpr unsigned kMaxRefusalsTold = 20;
inline constexpr double kRefusalSpan_s = 60;
/// The most bytes of a scene's name, and of a reason, in a text.
inline constexpr std::size_t kMaxNameLogged = 200, kMaxReasonLogged = 600;

class FarmLog {
 public:
  explicit FarmLog(double now_s = 0) : now_s_(now_s) {}
  /// Sets the time of what is told next (Unix time).
  void set_time(double unix_s);

  void farm_is_up(std::uint32_t nodes, const std::string& endpoint);
  void farm_goes_down(const std::string& why);
  /// A node that no job misses is lost.
  void node_is_lost(Rank rank, const std::string& name, const std::string& how, double noticed_s);
  /// A job loses a node that is gone, or messages. `name` tells who is gone, or who has missed
  /// them; `epochs` counts those of the job.
  void job_loses(std::uint32_t job, const Loss& loss, const std::string& name, bool is_gone,
                 std::uint32_t epochs);
  /// No process can be started for the node; `what` tells why, and whose is to be it, too.
  void node_has_host(const std::string& name, const std::string& what);
  void host_joins(const control::Join& host);
  void host_is_lost(const std::string& name, const std::string& how, std::size_t nodes);
  /// Hosts have come or gone: the farm has so many nodes from now on.
  void farm_is_fitted(std::uint32_t nodes, std::size_t hosts);
  /// A node's process has said hello. It is told if it takes the place of a lost one.
  void node_is_here(Rank rank, std::uint64_t pid);

  /// `is_recovered`: an earlier frontal had accepted it.
  void job_is_accepted(const control::JobInfo& job, bool is_recovered);
  /// `frontals` have begun it before, and have ended.
  void job_begins(const control::JobInfo& job, std::uint32_t frontals);
  void job_stands(std::uint32_t job, const std::string& waits_for);
  void job_ends(const control::JobInfo& job);

  void submission_is_refused(const std::string& scene, const std::string& why);
  /// A process that said it was a node.
  void hello_is_refused(std::uint32_t rank, const std::string& why);
  /// Somebody connected, and did not show a key of the farm's.
  void stranger_is_refused(const TurnedAway& peer);
  /// Connections that came when clients had as many as they may, or more.
  void crowd_is_refused(std::uint64_t connections, int most);

  /// What the frontal's process has to tell of itself.
  void process_tells(std::string text, bool is_trouble);

  std::vector<FarmEvent> take();

  // What is counted without being told
  void epoch_begins() { ++counts_.epochs; }
  /// So many tiles of a job that has ended had become whole.
  void tiles_were_made(std::uint64_t tiles) { counts_.tiles_whole += tiles; }
  /// A job's nodes have told what they did, and the frontal has sent so many bytes of slices.
  void nodes_reported(std::span<const control::NodeStats> nodes, std::uint64_t slice_bytes);
  const control::FarmCounts& counts() const { return counts_; }

 private:
  FarmEvent& note(FarmEvent::Kind kind, std::uint32_t job, std::string text);
  void refuse(std::string text);
  void tell_untold();

  double now_s_;
  std::deque<FarmEvent> events_;
  std::set<std::uint32_t> lost_ranks_;
  bool is_up_ = false;
  /// Since when refusals are counted, how many came since, and how many of them weren't told.
  double span_began_s_ = 0;
  unsigned refusals_ = 0;
  std::uint64_t untold_ = 0;
  control::FarmCounts counts_;
};

}  // namespace graycube
