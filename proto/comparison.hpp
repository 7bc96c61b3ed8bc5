// The figures that `graycube compare` takes from statistics, for each way to render a scene.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace graycube {

/// Evaluator seconds of one node.
struct NodeTimes {
  double busy_s = 0, blocked_s = 0, window_s = 0, idle_s = 0;
  /// Waiting for a FIFO that is a process apart.
  double fifo_wait_s = 0;
};

struct Figures {
  double wall_s = 0, cpu_s = 0, frontal_cpu_s = 0, render_s = 0, efficiency = 1,
         blocked_fraction = 0, endgame_s = 0;
  std::uint64_t forwarded = 0, messages = 0, message_bytes = 0, light_bytes = 0;
  /// Bytes of model and subdivision on the node that holds most.
  std::uint64_t largest_memory_bytes = 0;
  std::uint64_t rounds = 0, queue_peak = 0;
  /// Rays of all kinds; leaf regions or items of all nodes; rays intersected with a primitive.
  std::uint64_t rays = 0, cells = 0, tests = 0;
  std::vector<NodeTimes> nodes;
};

/// `statistics` must come from statistics_json.
Figures figures_of(const std::string& statistics);

enum class RowOutcome : std::uint8_t { kReference, kSame, kDifferent, kDeadlocked, kFailed };
/// "reference", "same", "DIFFERENT", "deadlocked", "FAILED".
std::string to_string(RowOutcome outcome);

struct ComparedRow {
  std::string name;
  /// The arguments of `graycube render` for this row.
  std::string arguments;
  RowOutcome outcome = RowOutcome::kSame;
  /// Why it failed; empty if it didn't.
  std::string why;
  /// A text of statistics_json; empty without a picture.
  std::string statistics;
};

/// A row of `graycube simulate`.
struct SimulatedRow {
  std::uint32_t nodes = 0;
  /// Seconds from the barrier to the end, or to the deadlock.
  double time_s = 0;
  /// Share of that time in which the frontal's link carried light.
  double host_load = 0;
  /// Seconds before the barrier in which slices were on their way.
  double distribution_s = 0;
  /// Hosts that the nodes lay on, bytes that nodes of different ones sent each other, and bytes
  /// that the frontal, on a host of its own, sent or got. 0 where no hosts are given.
  std::uint32_t hosts = 0;
  std::uint64_t bytes_between_hosts = 0, bytes_with_frontal = 0;
  /// CPU seconds as predicted, divided by those that the same work took here.
  double predicted_over_measured = 0;
  /// CPU seconds of each unit of work, by name.
  std::vector<std::pair<std::string, double>> costs;
  ComparedRow row;
};
/// One JSON object: {"scene", "rows": [{"nodes", "time_s", "distribution_s", "host_load",
/// "predicted_over_measured", "costs": {NAME: SECONDS}, "outcome", "why", "statistics"}]}. Rows
/// with hosts also have "hosts", "bytes_between_hosts" and "bytes_with_frontal".
std::string simulation_json(const std::string& scene, const std::vector<SimulatedRow>& rows);

/// One JSON object: {"scene", "nodes", "rows": [{"name", "arguments", "outcome", "why",
/// "statistics"}]}.
std::string comparison_json(const std::string& scene, std::uint32_t nodes,
                            const std::vector<ComparedRow>& rows);

}  // namespace graycube
