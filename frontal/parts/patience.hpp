// How long a frontal waits for its nodes. Nodes that share few cores get their turn seldom, so the
// time grows with the nodes on a core.
#pragma once

#include <algorithm>
#include <cstdint>

namespace graycube {

/// Seconds after which a silent node is taken for dead, if a core has no more than
/// kNodesInTime of them.
inline constexpr double kSilence_s = 2;
inline constexpr double kNodesInTime = 8;
/// Pings in that time: some answers may be late.
inline constexpr double kPingsInSilence = 4;
inline constexpr double kMaxPingInterval_s = 1;

inline double usual_silence_s(std::uint32_t nodes, unsigned cores) {
  const double nodes_on_a_core = static_cast<double>(nodes) / std::max(1u, cores);
  return kSilence_s * std::max(1.0, nodes_on_a_core / kNodesInTime);
}

/// Seconds between pings.
inline double ping_interval_s(double silence_s) {
  return std::min(kMaxPingInterval_s, silence_s / kPingsInSilence);
}

/// Seconds from a node's start to its hello.
inline double start_patience_s(std::uint32_t nodes) { return 10 + 0.25 * nodes; }

/// Seconds for which a node may be at the same pieces of work.
inline double standstill_s(double silence_s) { return 100 * silence_s; }

}  // namespace graycube
