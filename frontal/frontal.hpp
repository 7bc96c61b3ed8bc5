// The frontal's brain: a state machine over nodes, clients and jobs. Messages, deaths, the time and
// results of preparation go in; messages, and requests to start or end nodes, come out. main.cpp
// wires sockets, processes and clocks on; the simulation others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "frontal/jobs.hpp"
#include "frontal/parts/farm_log.hpp"
#include "frontal/parts/frontal_options.hpp"
#include "frontal/parts/heartbeat.hpp"
#include "frontal/parts/hosts/hosts.hpp"
#include "frontal/parts/node_door.hpp"
#include "frontal/parts/node_registry.hpp"
#include "frontal/parts/post.hpp"
#include "frontal/telling/log_desk.hpp"
#include "transport/message.hpp"

namespace graycube {

/// Requests for rows of pictures that may wait until those are read.
inline constexpr std::size_t kMaxWaitingFetches = 256;

class Frontal {
 public:
  using Outgoing = Post::Outgoing;
  /// A process that is to be started or ended.
  using Process = NodeRegistry::Process;
  /// A process that becomes another node, too.
  using Hosting = NodeRegistry::Hosting;

  /// The store must outlive the frontal.
  Frontal(FrontalOptions options, JobStore& store);
  Frontal(const Frontal&) = delete;
  Frontal& operator=(const Frontal&) = delete;
  /// Without a meter, the statistics tell of no CPU time.
  void set_cpu_meter(CpuMeter meter) {
    cpu_ = meter;
    jobs_.set_cpu_meter(std::move(meter));
  }

  /// Call before the events of that moment; also pings, notices silence and timeouts, and tells of
  /// progress.
  void on_time(const Moment& now);
  void on_message(const PeerId& peer, const MessageView& message);
  /// The same for a peer that has shown that it may be a host of the farm, and is no client.
  void on_host_message(const PeerId& peer, const MessageView& message);
  /// A node's process has ended; `how` for people ("killed by signal 9").
  void on_node_exit(const Process& process, const std::string& how);
  /// A process that was to be started can't be; `why` for people.
  void on_start_failure(const Process& process, const std::string& why);

  /// Preparing the next job, if there is one to prepare.
  std::optional<PreparationWork> take_work() {
    return is_writing_ || waits_for_hosts() ? std::nullopt : jobs_.take_work();
  }
  void give_result(PreparationResult result);
  /// The same for what a slide of the boundaries needs.
  std::optional<RecutWork> take_recut() { return jobs_.take_recut(); }
  void give_result(const RecutResult& cut);
  /// The same for files that are to be written. Until the result is given no job begins: the store
  /// keeps the picture as long.
  std::optional<WritingWork> take_writing() { return std::exchange(writing_, std::nullopt); }
  void give_result(WritingResult result);

  /// The same for a long scene that was submitted: nobody else's is taken until the result is
  /// given, and then its client is answered.
  std::optional<AdmissionWork> take_admission() { return jobs_.take_admission(); }
  void give_result(const AdmissionResult& result);
  bool is_admitting() const { return jobs_.is_admitting(); }

  /// The same for the picture of a job that is complete, and for one that is to be read before it
  /// can be fetched. Nobody is kept from anything else meanwhile, but that no other job begins
  /// until a complete one is kept.
  std::optional<KeepingWork> take_keeping() { return jobs_.take_keeping(); }
  void give_result(KeepingResult result);
  bool is_keeping() const { return jobs_.is_keeping(); }
  std::optional<ReadingWork> take_reading();
  void give_result(ReadingResult result);

  std::optional<std::uint32_t> job_that_is_on() const { return jobs_.job_that_is_on(); }

  std::vector<Outgoing> take_outgoing() { return post_.take(); }
  /// Processes for this machine; none where hosts run the nodes.
  std::vector<Process> take_starts() {
    return hosts_ ? std::vector<Process>() : nodes_.take_starts();
  }
  /// Silent nodes, whose processes are to be ended.
  std::vector<Process> take_kills() {
    return hosts_ ? std::vector<Process>() : nodes_.take_kills();
  }
  /// What has happened since it was last asked.
  std::vector<FarmEvent> take_events();
  /// A line of the process's own for the log.
  void process_tells(std::string text, bool is_trouble) {
    log_.process_tells(std::move(text), is_trouble);
  }
  /// A turn of the process's loop has taken so long.
  void had_a_turn(double seconds) { longest_turn_s_ = std::max(longest_turn_s_, seconds); }
  /// Somebody was hung up on, having shown no key of the farm.
  void turned_away(const TurnedAway& peer) { log_.stranger_is_refused(peer); }
  /// So many connections were closed at once, as clients had `most` already.
  void crowded_out(std::uint64_t connections, int most) {
    log_.crowd_is_refused(connections, most);
  }
  /// Names of the hosts that have joined.
  std::set<std::string> host_names() const {
    return hosts_ ? hosts_->names() : std::set<std::string>();
  }
  /// Nodes that end when their hosts' processes do, which have been told of them.
  std::vector<Hosting> take_hostings() { return nodes_.take_hostings(); }
  /// After `down`: nodes have been told to stop, and so should the process, once all have left.
  bool is_going_down() const { return is_going_down_; }
  bool all_nodes_left() const { return nodes_.all_left(); }
  /// Why the farm gave up; empty when it did not.
  const std::string& fatal_error() const { return fatal_error_; }
  /// Stops the farm, as a client or the operator wishes.
  void go_down();

 private:
  void on_hello(const PeerId& peer, const control::Hello& m, std::span<const std::byte> shown);
  void on_node(Rank rank, const ControlMessage& message);
  void on_client(const PeerId& peer, const ControlMessage& message, const SharedBytes& payload);
  // Answers to clients; nothing if they are sent later.
  std::optional<Answer> submit(const PeerId& peer, const control::Submit& m, SharedBytes scene);
  std::optional<Answer> write(const PeerId& peer, const control::Write& m);
  std::optional<Answer> fetch(const PeerId& peer, const control::Fetch& m);
  control::NodeList node_list() const;
  control::FarmInfo info() const;
  control::FarmMetrics metrics() const;
  void lose(Rank rank, const std::string& how) { lose(nodes_.in_process_of(rank), how); }
  void lose(const std::vector<Rank>& ranks, const std::string& how);
  void welcome();
  bool is_only_slow(Rank rank, std::uint64_t pid) const;
  // With hosts
  void on_host(const PeerId& peer, const ControlMessage& message);
  void on_join(const PeerId& peer, const control::Join& m);
  void on_node_ended(const PeerId& peer, const control::NodeEnded& m);
  void lose_host(const Hosts::Lost& host, const std::string& how);
  void look_after_hosts();
  void serve_hosts();
  void fit_to_hosts();
  bool waits_for_hosts() const;
  std::optional<std::string> node_folder_of(const control::Hello& m) const;
  bool finds_host(Rank rank, const std::string& why);
  void look_for_standstills();
  void get_on();

  FrontalOptions options_;
  double now_s_ = 0;
  NodeDoor door_;
  FarmLog log_;
  LogDesk log_desk_;
  CpuMeter cpu_;
  double longest_turn_s_ = 0;
  Post post_;
  Heartbeat heartbeat_;
  NodeRegistry nodes_;
  /// Where the nodes run, unless this machine runs them all.
  std::optional<Hosts> hosts_;
  Jobs jobs_;
  std::string fatal_error_;
  bool is_going_down_ = false;
  std::optional<WritingWork> writing_;
  bool is_writing_ = false;
  struct WaitingFetch {
    PeerId peer;
    control::Fetch request;
  };
  /// Requests for pictures that are not in memory.
  std::vector<WaitingFetch> fetches_;
  bool is_reading_ = false;
};

}  // namespace graycube
