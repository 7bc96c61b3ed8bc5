// The options that a frontal is started with, and the times and CPU costs that it is told.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "frontal/preparation/preparation.hpp"
#include "frontal/rendering/flow_limits.hpp"
#include "frontal/rendering/retries.hpp"
#include "topology/hypercube.hpp"
#include "transport/secret.hpp"

namespace graycube {

struct FrontalOptions {
  /// The farm's nodes. Where hosts run them it changes between jobs.
  Hypercube cube;
  /// Where hosts run the nodes: the most that the farm may have, a power of two. Otherwise the
  /// frontal's own machine runs them.
  std::optional<std::uint32_t> most_nodes_on_hosts{};
  /// The port at which nodes of hosts find the frontal.
  std::uint32_t nodes_port = 0;
  /// Evaluator threads per node.
  std::uint32_t threads = 1;
  double heartbeat_s = 1;
  /// A node that answers nothing for so many seconds is taken for dead; and so is one that hasn't
  /// said hello so many seconds after it was started.
  double silence_s = 10, start_patience_s = 60;
  /// Whether a silent node's process, of that id, can run and only doesn't get its turn: then it
  /// may be silent for kPatienceWithSlow times as long.
  std::function<bool(std::uint64_t)> is_only_slow = [](std::uint64_t) { return false; };
  /// A node that answers, but has been at the same pieces of work for so many seconds, is taken for
  /// dead.
  double standstill_s = 300;
  /// Losses at which a tile may be under way before the job fails.
  std::uint32_t retries = kDefaultRetries;
  std::string version;
  /// Models of more bytes are not replicated.
  std::uint64_t replica_bytes = kReplicaBytes;
  FlowLimits limits{};
  /// Hosts that the nodes lie on: what is sent between hosts costs more.
  std::uint32_t hosts = 1;
  /// Clients may send scenes that they have compiled. Only for a client that is trusted: what
  /// readers of scenes check, such as that a camera has a direction, is not checked again.
  bool is_private = false;
  /// Jobs that have not ended when the farm stops go on when it is started again; else they are
  /// cancelled.
  bool keeps_jobs = false;
  /// Tiles that are whole are recorded in the store.
  bool records_tiles = false;
  /// A digest of what decides the picture of the only job, by which records of tiles are known; 0
  /// where it is that of what was submitted.
  std::uint64_t picture_content = 0;
  /// Of the frontal's process, for those who ask: where it listens, its number, and since when it
  /// runs (Unix time).
  std::string endpoint{};
  std::uint64_t pid = 0;
  double started_s = 0;
  /// What the farm's nodes show when they say hello, and the folder of their inboxes. Without a
  /// secret, as in simulations, neither is checked.
  std::optional<Secret> secret{};
  std::string node_folder{};
};

/// Seconds on a clock that never goes back, and Unix time.
struct Moment {
  double now_s = 0, unix_s = 0;
};

/// Tells the CPU seconds that the frontal's process has used so far, and how many of them it took
/// to start processes, this one included.
struct CpuMeter {
  std::function<double()> used_s = [] { return 0.0; };
  std::function<double()> starting_s = [] { return 0.0; };
};

}  // namespace graycube
