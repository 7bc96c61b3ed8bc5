// The node processes that a frontal starts, and only those.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "topology/rank.hpp"
#include "transport/secret.hpp"

namespace graycube {

/// A node, with the number of its start.
struct NodeStart {
  Rank rank;
  std::uint32_t incarnation;
  friend bool operator==(const NodeStart&, const NodeStart&) = default;
};

/// What all nodes of a farm are told when they are started.
struct NodeSetting {
  /// The frontal's endpoint, and evaluators of a node.
  std::string frontal;
  std::uint32_t threads = 1;
  /// The address at which nodes listen for those of other hosts; empty if there are none.
  std::string address{};
};

struct NodeExit {
  NodeStart node;
  /// For people: "killed by signal 9", "exited with status 1"; or why it can't be started.
  std::string how;
  bool was_started = true;
};

class NodeProcesses {
 public:
  /// `program` is graycube-node; inboxes are made in `folder`. Nodes inherit the secret.
  NodeProcesses(std::filesystem::path program, std::filesystem::path folder, const Secret& secret);
  /// Kills the processes that are left, and waits for them.
  ~NodeProcesses();
  NodeProcesses(const NodeProcesses&) = delete;
  NodeProcesses& operator=(const NodeProcesses&) = delete;

  /// All of them are forked from one process, which has been loaded and linked once and then ends.
  /// Those that the system has no descriptors, processes or memory for are tried again by later
  /// calls, which may have no new nodes; reap() tells of those that it never has any for.
  void start(std::span<const NodeStart> nodes, const NodeSetting& setting, double now_s);
  /// The process of `host` is `guest`, too, from now on.
  void host(const NodeStart& guest, const NodeStart& host);
  /// Kills the node's process.
  void end(const NodeStart& node);
  void end_all();
  /// Ranks of nodes whose processes something keeps from running, such as a signal.
  std::vector<std::uint32_t> stopped() const;
  /// The nodes whose processes have ended, or couldn't be started, since the last call.
  std::vector<NodeExit> reap();
  bool empty() const { return running_.empty(); }
  /// CPU time that starting took in processes that are no nodes.
  double start_cpu_s() const { return start_cpu_s_; }

 private:
  using Nodes = std::vector<NodeStart>;
  std::map<pid_t, Nodes>::iterator process_of(const NodeStart& node);
  void start_waiting(const NodeSetting& setting, std::string& why);

  std::filesystem::path program_, folder_;
  Secret secret_;
  double start_cpu_s_ = 0;
  /// The nodes of each process: one, and those that it hosts.
  std::map<pid_t, Nodes> running_;
  struct Waiting {
    NodeStart node;
    unsigned tries = 0;
  };
  std::vector<Waiting> waiting_;
  double next_try_s_ = 0;
  /// What the next reap() tells of nodes that have no process.
  std::vector<NodeExit> without_process_;
};

}  // namespace graycube
