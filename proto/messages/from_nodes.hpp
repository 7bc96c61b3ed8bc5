// Control messages from a node to the frontal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages/values.hpp"

namespace graycube::control {

struct Hello {
  static constexpr std::string_view kType = "hello";
  std::uint32_t rank = 0;
  std::uint64_t pid = 0;
  std::uint32_t incarnation = 0;
  /// The endpoint at which the node's inbox listens.
  std::string endpoint{};
  std::uint32_t threads = 1;
  std::string version{};
  /// Where the inbox listens for nodes of other hosts; empty if it doesn't.
  std::string remote_endpoint{};
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// The node's macro-regions are subdivided.
struct Ready {
  static constexpr std::string_view kType = "ready";
  std::uint32_t job = 0, epoch = 0;
  std::uint64_t primitives = 0, objects = 0, leaves = 0;
  double build_s = 0;
  friend bool operator==(const Ready&, const Ready&) = default;
};

/// The node has dropped everything of older epochs. A frontal that begins one waits for this, and
/// so does one that sends slices over links.
struct EpochAck {
  static constexpr std::string_view kType = "epoch_ack";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const EpochAck&, const EpochAck&) = default;
};

/// Rank 0 only: the token came round without ending the image.
struct TokenRound {
  static constexpr std::string_view kType = "token_round";
  std::uint32_t job = 0, epoch = 0, round = 0, hops = 0;
  bool black = false;
  std::int64_t count = 0;
  friend bool operator==(const TokenRound&, const TokenRound&) = default;
};

/// Rank 0 only: the token's verdict, with the number of contribution batches that the frontal must
/// hold by then.
struct Terminated {
  static constexpr std::string_view kType = "terminated";
  std::uint32_t job = 0, epoch = 0, rounds = 0, hops = 0;
  std::uint64_t contribution_batches = 0;
  friend bool operator==(const Terminated&, const Terminated&) = default;
};

struct NodeReport {
  static constexpr std::string_view kType = "node_report";
  std::uint32_t job = 0, epoch = 0;
  NodeStats stats{};
  friend bool operator==(const NodeReport&, const NodeReport&) = default;
};

struct Pong {
  static constexpr std::string_view kType = "pong";
  std::uint64_t sequence = 0;
  /// Pieces of work that evaluators have done in the job so far, and those that are under way.
  std::uint64_t moves = 0, working = 0;
  friend bool operator==(const Pong&, const Pong&) = default;
};

/// What the node waits for, sent behind each pong if flow is blocking. The frontal finds cycles in
/// these.
struct WaitReport {
  static constexpr std::string_view kType = "wait_report";
  std::uint32_t job = 0, epoch = 0;
  /// The sequence of the ping that is answered.
  std::uint64_t ping = 0;
  /// Whether the evaluator holds a ray for which the queue across bit `waits_for` has no room.
  bool is_stalled = false;
  std::uint32_t waits_for = 0;
  /// Pieces of work done in the job so far.
  std::uint64_t moves = 0;
  /// Credit granted to, and received from, the neighbour across each bit: bytes of ray records.
  std::vector<std::uint64_t> granted{}, received{};
  friend bool operator==(const WaitReport&, const WaitReport&) = default;
};

/// Asks for another node's model slice, to finish shadow rays.
struct Borrow {
  static constexpr std::string_view kType = "borrow";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  /// Bytes of the largest slice that the node has room for.
  std::uint64_t room_bytes = 0;
  friend bool operator==(const Borrow&, const Borrow&) = default;
};

/// Asks the frontal to send an idle neighbour a copy of this node's slice, to help it.
struct Share {
  static constexpr std::string_view kType = "share";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Share&, const Share&) = default;
};

/// The node can't go on with this epoch of the job, as something was lost; or, if it is final, with
/// the job. Job 0: it can't go on at all.
struct NodeError {
  static constexpr std::string_view kType = "node_error";
  std::uint32_t job = 0, epoch = 0;
  std::string message{};
  /// Another epoch would end in the same way.
  bool is_final = false;
  friend bool operator==(const NodeError&, const NodeError&) = default;
};

/// Nothing more will come from this node.
struct Goodbye {
  static constexpr std::string_view kType = "goodbye";
  friend bool operator==(const Goodbye&, const Goodbye&) = default;
};

}  // namespace graycube::control
