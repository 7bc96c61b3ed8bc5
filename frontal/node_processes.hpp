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
  /// `program` is graycube-node; inboxes are made in `folder`.
  NodeProcesses(std::filesystem::path program, std::filesystem::path folder, std::uint32_t threads);
  /// Kills the processes that are left, and waits for them.
  ~NodeProcesses();
  NodeProcesses(const NodeProcesses&) = delete;
  NodeProcesses& operator=(const NodeProcesses&) = delete;

  /// All of them are forked from one process, which has been loaded and linked once and then ends.
  /// Throws std::system_error when they can't be started.
  void start(std::span<const NodeStart> nodes, const std::string& frontal);
  void end(Rank rank, std::uint32_t incarnation);
  /// The children that have ended since the last call.
  std::vector<NodeExit> reap();
  bool empty() const { return running_.empty(); }
  /// CPU time that starting took in processes that are no nodes.
  double start_cpu_s() const { return start_cpu_s_; }

 private:
  std::filesystem::path program_, folder_;
  std::uint32_t threads_;
  double start_cpu_s_ = 0;
  std::map<pid_t, NodeStart> running_;
};

}  // namespace graycube
