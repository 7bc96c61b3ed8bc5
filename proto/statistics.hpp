// The statistics file: one JSON object for each render (docs/statistics.md).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "proto/messages/sliding_figures.hpp"
#include "shading/settings.hpp"

namespace graycube {

struct Statistics {
  std::string version, scene;
  /// Why there is no picture; empty when there is one.
  std::string failed;
  Algorithm algorithm = Algorithm::kSerial;
  std::uint32_t nodes = 1, threads = 1, dimension = 0;
  std::array<std::uint32_t, 2> grid{1, 1};
  /// The scatter that was picked, in `macro`.
  std::uint32_t scatter = 1;
  ShadowMode shadows = ShadowMode::kForward;
  PartitionMode partition = PartitionMode::kRegular;
  FlowMode flow = FlowMode::kCredit;
  SumsMode sums = SumsMode::kDirect;
  SubdivisionChoice subdivision;
  ReturnsMode returns = ReturnsMode::kFrontal;
  BoundariesMode boundaries = BoundariesMode::kFixed;
  SlidingFigures sliding;
  ImageSize image;
  std::uint64_t primitives = 0, objects = 0;
  double wall_s = 0, cpu_s = 0;
  /// The frontal's part of cpu_s.
  double frontal_cpu_s = 0;
  /// The part of cpu_s that went into starting processes.
  double start_cpu_s = 0;
  double load_s = 0, partition_s = 0, build_s = 0, render_s = 0;
  std::uint32_t token_rounds = 0, token_hops = 0;
  /// The nodes' own reports, indexed by rank. Totals are sums over these.
  std::vector<control::NodeStats> per_node;
};

/// The statistics as one line of JSON.
std::string statistics_json(const Statistics& statistics);

/// The statistics with the time and CPU that the command itself used: wall_s is replaced, cpu_s and
/// load_s (reading and compiling the scene) are added. `text` must come from statistics_json; an
/// empty text stays empty.
std::string with_command_times(const std::string& text, double wall_s, double cpu_s,
                               double load_s = 0);

}  // namespace graycube
