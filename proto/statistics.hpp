// The statistics file: one JSON object for each render (docs/statistics.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "proto/messages/sliding_figures.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// Most losses that statistics tell of, the first ones.
inline constexpr std::size_t kMaxLossesListed = 256;

/// What was lost while a job was on the nodes.
struct Loss {
  /// The node that was lost, or that told of a lost batch; nothing if nobody knows.
  std::optional<std::uint32_t> rank;
  std::string why;
  /// Seconds for which nothing had been heard of a lost node; 0 for a batch.
  double noticed_s = 0;
  /// Tiles that were under way, and are traced again.
  std::uint32_t tiles = 0;
};

struct Statistics {
  std::string version, scene;
  /// Why there is no picture; empty when there is one.
  std::string failed;
  Algorithm algorithm = Algorithm::kSerial;
  std::uint32_t nodes = 1, threads = 1, dimension = 0;
  /// Columns and rows of the mesh of nodes; in a 3D mesh, slabs too.
  std::vector<std::uint32_t> grid{1, 1};
  MeshMode mesh = MeshMode::k2d;
  /// The scatter that was picked, in `macro`.
  std::uint32_t scatter = 1;
  ShadowMode shadows = ShadowMode::kForward;
  PartitionMode partition = PartitionMode::kRegular;
  FlowMode flow = FlowMode::kCredit;
  FifoMode fifo = FifoMode::kThread;
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
  /// Tries at the picture, each but the first after a loss (docs/design/epochs.md).
  std::uint32_t epochs = 1;
  std::vector<Loss> losses;
  /// Tiles that were not traced, since an earlier process had recorded them.
  std::uint64_t resumed_tiles = 0;
  std::uint32_t token_rounds = 0, token_hops = 0;
  /// Slices that the frontal sent when the job was loaded.
  std::uint64_t slices = 0, slice_bytes = 0;
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
