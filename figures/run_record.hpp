// What travels between the nodes of a farm while it renders a scene with `macro`: the real brains
// on a simulated machine (simulation/farm.hpp) with fixed costs, so that a run is the same
// everywhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "simulation/farm.hpp"
#include "topology/hypercube.hpp"
#include "trace/ray_task.hpp"

namespace graycube::figures {

/// A batch of rays from a node to its neighbour. Times are in simulated seconds since the frontal
/// let the nodes start.
struct RayShipment {
  Rank from, to;
  double sent_s = 0, arrived_s = 0;
  std::uint32_t rays = 0;
};

/// The token handed on.
struct TokenHop {
  Rank from, to;
  double sent_s = 0, arrived_s = 0;
  std::uint32_t round = 0;
  bool is_black = false;
  std::int64_t count = 0;
};

/// A ray as a node receives it.
struct ReceivedRay {
  Rank at, from;
  RayTask ray;
};

struct RunRecord {
  std::vector<RayShipment> shipments;
  std::vector<TokenHop> token;
  /// Some of each batch, until there are kMostRays.
  std::vector<ReceivedRay> rays;
  /// Whether there were more shipments than kMostShipments: those are missing.
  bool is_cut_short = false;
  /// The time of the last thing recorded, or of the token's verdict.
  double end_s = 0;
  control::GridLayout grid;
  simulation::Outcome outcome;

  static constexpr std::size_t kMostShipments = std::size_t{1} << 21, kMostRays = 4096;
};

/// Renders the scene of this text, in Graycube's own format, on a simulated farm.
RunRecord record_run(const std::string& scene, const control::JobOptions& options,
                     std::uint32_t nodes);

}  // namespace graycube::figures
