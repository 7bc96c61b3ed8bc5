// How those who run a farm see what it does: what it has counted since its frontal's start, and the
// last lines of its log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages/clients.hpp"

namespace graycube {

/// Lines of its log that a frontal keeps, and the most that one answer has: with each as long as it
/// may be, and all of it escaped, a message still holds them.
inline constexpr std::size_t kMaxLinesKept = 1000, kMaxLinesAnswered = 400;
/// The longest that a request for lines may wait for one to come.
inline constexpr double kMaxLogWait_s = 20;

namespace control {

/// Asks for a farm's figures.
struct Metrics {
  static constexpr std::string_view kType = "metrics";
  friend bool operator==(const Metrics&, const Metrics&) = default;
};

/// What a frontal has counted since its start. What nodes do is known when a job ends whose nodes
/// report; that of jobs without a picture isn't told.
struct FarmCounts {
  std::uint64_t jobs_accepted = 0, jobs_done = 0, jobs_failed = 0, jobs_cancelled = 0;
  /// Tiles that have become whole, those of the running job too.
  std::uint64_t tiles_whole = 0;
  std::uint64_t nodes_lost = 0, messages_lost = 0;
  /// Tries at a picture that losses made necessary.
  std::uint64_t epochs = 0;
  /// Submissions, processes that said they were nodes, clients without the key, and connections
  /// beyond those that clients may have.
  std::uint64_t refused_submissions = 0, refused_nodes = 0, refused_clients = 0,
                refused_connections = 0;
  // Sums over the nodes' reports (NodeStats)
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  std::uint64_t forwarded_primary = 0, forwarded_shadow = 0, forwarded_secondary = 0;
  std::uint64_t ray_batches = 0, ray_bytes = 0, contribution_batches = 0, contribution_bytes = 0;
  std::uint64_t sum_batches = 0, sum_bytes = 0, answer_batches = 0, answer_bytes = 0;
  /// Parts of scenes; of these the frontal's own, too.
  std::uint64_t slice_batches = 0, slice_bytes = 0;
  std::uint64_t malformed_drops = 0;
  double busy_s = 0, blocked_s = 0, window_s = 0, idle_s = 0, fifo_wait_s = 0, nodes_cpu_s = 0;
  /// Of the job that reported last: the largest of its nodes' values.
  std::uint64_t last_queue_peak = 0, last_outbox_peak = 0, last_memory_bytes = 0;
  friend bool operator==(const FarmCounts&, const FarmCounts&) = default;
};

struct FarmMetrics {
  static constexpr std::string_view kType = "farm_metrics";
  FarmInfo farm{};
  FarmCounts counts{};
  std::uint32_t nodes_starting = 0, nodes_idle = 0, nodes_busy = 0, nodes_lost = 0;
  /// The part of the running job that is done, 0 … 1; 0 where none is on.
  double fraction = 0;
  /// The frontal's CPU time, and the longest that one turn of its loop has taken: whoever asks it
  /// something waits that long.
  double frontal_cpu_s = 0, longest_turn_s = 0;
  friend bool operator==(const FarmMetrics&, const FarmMetrics&) = default;
};

/// Asks for lines of the farm's log, of those after the line with number `after` the newest
/// `newest`.
struct Log {
  static constexpr std::string_view kType = "log";
  /// The frontal's process, which has numbered that line; 0 if none has. Another one's are new.
  std::uint64_t pid = 0, after = 0;
  std::uint32_t newest = 0;
  /// Seconds after which the answer comes even if there is no line.
  double wait_s = 0;
  friend bool operator==(const Log&, const Log&) = default;
};

struct LogLine {
  /// Lines count from 1.
  std::uint64_t number = 0;
  double unix_s = 0;
  /// The job that it is about; 0 if it is about none.
  std::uint32_t job = 0;
  /// Something went wrong.
  bool is_trouble = false;
  /// For people. It may quote what clients have sent.
  std::string text{};
  friend bool operator==(const LogLine&, const LogLine&) = default;
};

/// The oldest kMaxLinesAnswered of the lines that were asked for.
struct LogLines {
  static constexpr std::string_view kType = "log_lines";
  std::uint64_t pid = 0;
  /// The farm goes down: after these lines no others come.
  bool is_end = false;
  std::vector<LogLine> lines{};
  friend bool operator==(const LogLines&, const LogLines&) = default;
};

}  // namespace control
}  // namespace graycube
