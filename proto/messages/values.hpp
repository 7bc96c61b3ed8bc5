// What control messages are made of: what a job may ask for, what is known of nodes and jobs, and
// the limits. Times are in seconds; jobs count from 1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "regions/macro_grid.hpp"
#include "topology/hypercube.hpp"

namespace graycube {

inline constexpr std::uint32_t kMaxThreads = 1024;
/// Longest names, endpoints and versions, and longest messages for people; UTF-8 bytes.
inline constexpr std::size_t kMaxNameBytes = 256;
inline constexpr std::size_t kMaxTextBytes = 1024;
/// Longest JSON text of a job's statistics.
inline constexpr std::size_t kMaxStatsBytes = 768 * 1024;
inline constexpr std::size_t kMaxJobsListed = 256;
inline constexpr std::size_t kMaxErrorsListed = 100;
/// Largest binary frame behind `submit` (the scene's text) and behind `picture`.
inline constexpr std::size_t kMaxSubmitBytes = std::size_t{1} << 28;
/// Writing larger pictures would keep a frontal from everything else for too long.
inline constexpr std::uint64_t kMostPixelsToWrite = std::uint64_t{1} << 22;
inline constexpr std::size_t kMaxPictureBytes = std::size_t{1} << 26;
/// Most macro-regions per node along either side of the grid.
inline constexpr std::uint32_t kMaxScatter = 8;
/// Rays that a node's input queues hold together where flow is blocking.
inline constexpr std::uint32_t kDefaultQueue = 64;
inline constexpr std::uint32_t kMaxQueue = 1u << 16;
/// Rays that a node's outboxes hold before it is full, where nothing else is asked for.
inline constexpr std::uint32_t kDefaultOutboxRays = 1u << 18;

enum class Algorithm : std::uint8_t { kAuto, kSerial, kRoth, kMacro };
enum class Grain : std::uint8_t { kPixel, kLine, kTile };
enum class ShadowMode : std::uint8_t { kHorizon, kForward, kLocal };
enum class PartitionMode : std::uint8_t { kRegular, kBalanced, kAuto };
enum class FlowMode : std::uint8_t { kCredit, kBlocking };
/// How contributions reach the frontal: from each node by itself, or added up along the hypercube's
/// tree.
enum class SumsMode : std::uint8_t { kDirect, kTree };
enum class JobState : std::uint8_t {
  kQueued,
  kLoading,
  kBuilding,
  kRendering,
  kDone,
  kFailed,
  kCancelled
};
enum class NodeState : std::uint8_t { kStarting, kIdle, kBusy, kLost };
enum class FailureCode : std::uint8_t {
  kBadInput,
  kFailed,
  kCancelled,
  kTimeout,
  kUnknownJob,
  kBusy,
  kNotDone,
  kTooLarge,
  kBadRequest,
  /// Nodes wait for each other in a circle, and statistics tell what they did.
  kDeadlock
};

/// Names as on the wire and on the command line; empty for a value outside the enum.
std::string_view to_string(Algorithm value);
std::string_view to_string(Grain value);
std::string_view to_string(ShadowMode value);
std::string_view to_string(PartitionMode value);
std::string_view to_string(FlowMode value);
std::string_view to_string(SumsMode value);
std::string_view to_string(JobState value);
std::string_view to_string(NodeState value);
std::string_view to_string(FailureCode value);

/// JSON text of one object, carried as it is.
struct RawObject {
  std::string text = "{}";
  friend bool operator==(const RawObject&, const RawObject&) = default;
};

namespace control {

/// A node's record of one job: the fields of `per_node` in the statistics file, and what the
/// frontal sums.
struct NodeStats {
  std::uint32_t rank = 0, gray = 0;
  std::uint64_t pid = 0;
  double cpu_s = 0, busy_s = 0, idle_s = 0, blocked_s = 0, window_s = 0;
  /// What of cpu_s the process took before its first job came; 0 in those after it.
  double start_cpu_s = 0;
  std::uint64_t rays_in = 0, rays_out = 0, queue_peak = 0, primitives = 0, peak_rss_bytes = 0;
  /// Rays, counted where they are created.
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  std::uint64_t skipped_by_horizon = 0, forwarded_shadow = 0, forwarded_secondary = 0;
  std::uint64_t ray_batches = 0, ray_bytes = 0, contribution_batches = 0, contribution_bytes = 0;
  /// Contributions sent to the parent in the tree of sums; those above went to the frontal.
  std::uint64_t sum_batches = 0, sum_bytes = 0;
  /// Components of contributions mended while rounding; batches and messages refused.
  std::uint64_t non_finite = 0, clamped = 0, malformed_drops = 0;
  /// Most rays that lay in the outboxes at a time.
  std::uint64_t outbox_peak = 0;
  /// Model and subdivision, borrowed ones and copies included.
  std::uint64_t memory_bytes = 0;
  /// Other nodes' models, fetched to finish shadow rays here, or got to help them.
  std::uint64_t models_borrowed = 0;
  /// Other nodes' tiles, and rays received by them, that were traced here.
  std::uint64_t tiles_taken_over = 0, rays_taken_over = 0;
  /// From the end of the node's last primary ray to its report.
  double endgame_s = 0;
  friend bool operator==(const NodeStats&, const NodeStats&) = default;
};

/// Overrides and choices of a render; what a client leaves out keeps the default.
struct JobOptions {
  Algorithm algorithm = Algorithm::kAuto;
  Grain grain = Grain::kTile;
  ShadowMode shadows = ShadowMode::kHorizon;
  PartitionMode partition = PartitionMode::kAuto;
  /// K: K × K macro-regions per node; 0: what suits the scene.
  std::uint32_t scatter = 0;
  FlowMode flow = FlowMode::kCredit;
  /// Rays that a node's input queues hold together where flow is blocking.
  std::uint32_t queue = kDefaultQueue;
  /// Evaluator threads per node; 0: what the node was started with.
  std::uint32_t threads = 0;
  /// Seconds; 0: no limit.
  double timeout_s = 0;
  /// The scene's own values where absent.
  std::optional<std::uint32_t> width{}, height{}, samples{}, max_depth{};
  /// Names as parse_aovs reads them.
  std::string aov{};
  SumsMode sums = SumsMode::kDirect;
  friend bool operator==(const JobOptions&, const JobOptions&) = default;
};

/// The grid of macro-regions: `scatter` × `scatter` per node, region (i, j) on node
/// (i mod columns/scatter, j mod rows/scatter).
struct GridLayout {
  std::uint32_t columns = 1, rows = 1, scatter = 1;
  /// Inner boundaries as pixel edges, strictly increasing, one fewer than columns (rows).
  std::vector<std::int64_t> column_edges{}, row_edges{};
  /// By row: between the pixels whose primary rays its nodes trace, one fewer than columns. Empty:
  /// those of their macro-regions.
  std::vector<std::int64_t> own_edges{};
  friend bool operator==(const GridLayout&, const GridLayout&) = default;
};

struct TokenProgress {
  std::uint32_t round = 0, hops = 0;
  friend bool operator==(const TokenProgress&, const TokenProgress&) = default;
};

struct ErrorItem {
  /// A JSON pointer into the scene, a node, an option.
  std::string where{};
  std::string why{};
  friend bool operator==(const ErrorItem&, const ErrorItem&) = default;
};

struct NodeInfo {
  std::uint32_t rank = 0, gray = 0;
  std::uint64_t pid = 0;
  NodeState state = NodeState::kStarting;
  std::string endpoint{};
  std::uint32_t threads = 1;
  friend bool operator==(const NodeInfo&, const NodeInfo&) = default;
};

}  // namespace control
}  // namespace graycube
