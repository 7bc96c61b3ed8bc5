// Control messages between the frontal and hosts: machines that joined the farm with
// `graycube join`, and run nodes as they are told.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages/values.hpp"

namespace graycube::control {

// ---- From a host

/// First of all; the sender has shown the farm's key.
struct Join {
  static constexpr std::string_view kType = "join";
  /// The host's name, for people.
  std::string host{};
  /// Processes whose hosts have the same tag can reach each other's local sockets.
  std::string tag{};
  /// The folder of its nodes' local sockets.
  std::string folder{};
  std::uint32_t cores = 1;
  std::uint64_t memory_bytes = 0;
  /// Nodes that it is meant for.
  std::uint32_t slots = 1;
  std::uint64_t pid = 0;
  std::string version{};
  friend bool operator==(const Join&, const Join&) = default;
};

/// A node's process has ended, or couldn't be started.
struct NodeEnded {
  static constexpr std::string_view kType = "node_ended";
  std::uint32_t rank = 0, incarnation = 0;
  /// For people: "killed by signal 9".
  std::string how{};
  bool was_started = true;
  friend bool operator==(const NodeEnded&, const NodeEnded&) = default;
};

/// Answers `ping`.
struct Alive {
  static constexpr std::string_view kType = "alive";
  std::uint64_t sequence = 0;
  /// The ranks of its nodes whose processes something keeps from running, such as a signal.
  std::vector<std::uint32_t> stopped{};
  friend bool operator==(const Alive&, const Alive&) = default;
};

/// The host goes, in order: its nodes are ending.
struct Leave {
  static constexpr std::string_view kType = "leave";
  friend bool operator==(const Leave&, const Leave&) = default;
};

// ---- To a host

struct Joined {
  static constexpr std::string_view kType = "joined";
  /// Where nodes find the frontal: a port of the host that the host found it at.
  std::uint32_t nodes_port = 0;
  /// Evaluators of a node.
  std::uint32_t threads = 1;
  /// Milliseconds between pings, and of silence after which the frontal counts as dead.
  std::uint32_t heartbeat_ms = 1000, silence_ms = 2000;
  friend bool operator==(const Joined&, const Joined&) = default;
};

struct NodeToRun {
  std::uint32_t rank = 0, incarnation = 0;
  friend bool operator==(const NodeToRun&, const NodeToRun&) = default;
};

/// Asks for a process for each of these nodes.
struct RunNodes {
  static constexpr std::string_view kType = "run_nodes";
  std::vector<NodeToRun> nodes{};
  friend bool operator==(const RunNodes&, const RunNodes&) = default;
};

/// Asks to kill a node's process.
struct EndNode {
  static constexpr std::string_view kType = "end_node";
  std::uint32_t rank = 0, incarnation = 0;
  friend bool operator==(const EndNode&, const EndNode&) = default;
};

}  // namespace graycube::control
