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

struct NodeStart {
  Rank rank;
  std::uint32_t incarnation;
};

struct NodeExit {
  Rank rank;
  std::uint32_t incarnation;
  /// For people: "killed by signal 9", "exited with status 1".
  std::string how;
};

class NodeProcesses {
 public:
  /// `program` is graycube-node; inboxes are made in `folder`. Nodes inherit the secret.
  NodeProcesses(std::filesystem::path program, std::filesystem::path folder, std::uint32_t threads,
                const Secret& secret);
  /// Kills the processes that are left, and waits for them.
  ~NodeProcesses();
  NodeProcesses(const NodeProcesses&) = delete;
  NodeProcesses& operator=(const NodeProcesses&) = delete;

  /// All of them are forked from one process, which has been loaded and linked once and then ends.
  /// Those that the system has no descriptors, processes or memory for are tried again by later
  /// calls, which may have no new nodes; those that it never has any for count as exits.
  void start(std::span<const NodeStart> nodes, const std::string& frontal, double now_s);
  void end(Rank rank, std::uint32_t incarnation);
  /// The children that have ended, or couldn't be started, since the last call.
  std::vector<NodeExit> reap();
  bool empty() const { return running_.empty(); }
  /// CPU time that starting took in processes that are no nodes.
  double start_cpu_s() const { return start_cpu_s_; }

 private:
  void start_waiting(const std::string& frontal, std::string& why);

  std::filesystem::path program_, folder_;
  Secret secret_;
  std::uint32_t threads_;
  double start_cpu_s_ = 0;
  std::map<pid_t, NodeStart> running_;
  struct Waiting {
    NodeStart node;
    unsigned tries = 0;
  };
  std::vector<Waiting> waiting_;
  double next_try_s_ = 0;
  std::vector<NodeExit> not_started_;
};

}  // namespace graycube
