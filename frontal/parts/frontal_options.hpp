// The options that a frontal is started with, and the times and CPU costs that it is told.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "frontal/preparation/preparation.hpp"
#include "frontal/rendering/flow_limits.hpp"
#include "topology/hypercube.hpp"
#include "transport/secret.hpp"

namespace graycube {

struct FrontalOptions {
  Hypercube cube;
  /// Evaluator threads per node.
  std::uint32_t threads = 1;
  double heartbeat_s = 1;
  /// A node that answers nothing for so many seconds is taken for dead.
  double silence_s = 10;
  std::string version;
  /// Models of more bytes are not replicated.
  std::uint64_t replica_bytes = kReplicaBytes;
  FlowLimits limits{};
  /// Clients may send scenes that they have compiled. Only for a client that is trusted: what
  /// readers of scenes check, such as that a camera has a direction, is not checked again.
  bool is_private = false;
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
