// The parts of control messages: options of a job, records of nodes and jobs, and limits. Times are
// in seconds; jobs count from 1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "regions/macro_grid.hpp"
#include "subdivisions/subdivision.hpp"
#include "topology/hypercube.hpp"
#include "topology/node_mesh.hpp"

namespace graycube {

inline constexpr std::uint32_t kMaxThreads = 1024;
/// Most UTF-8 bytes of names, endpoints and versions, and of messages for people.
inline constexpr std::size_t kMaxNameBytes = 256;
inline constexpr std::size_t kMaxTextBytes = 1024;
/// Most bytes of the key under which a job is submitted.
inline constexpr std::size_t kMaxKeyBytes = 64;
/// Most bytes of the JSON text of a job's statistics.
inline constexpr std::size_t kMaxStatsBytes = 768 * 1024;
inline constexpr std::size_t kMaxJobsListed = 256;
inline constexpr std::size_t kMaxErrorsListed = 100;
/// Most bytes of the binary frames behind `submit` (the scene's text) and behind `picture`.
inline constexpr std::size_t kMaxSubmitBytes = std::size_t{1} << 28;
/// Writing pictures with more pixels would keep a frontal from everything else for too long.
inline constexpr std::uint64_t kMostPixelsToWrite = std::uint64_t{1} << 22;
inline constexpr std::size_t kMaxPictureBytes = std::size_t{1} << 26;
/// Most macro-regions per node along either side of the grid.
inline constexpr std::uint32_t kMaxScatter = 8;
/// Rays that a node's input queues hold together if flow is blocking.
inline constexpr std::uint32_t kDefaultQueue = 64;
inline constexpr std::uint32_t kMaxQueue = 1u << 16;
/// Losses that a tile or slice may have to do with, unless the farm is started with another number.
inline constexpr std::uint32_t kDefaultRetries = 3;
inline constexpr std::uint32_t kMaxRetries = 100;
/// Rays that a node's outboxes hold before it is full, unless a frontal sets another number.
inline constexpr std::uint32_t kDefaultOutboxRays = 1u << 18;

enum class Algorithm : std::uint8_t { kAuto, kSerial, kRoth, kMacro };
enum class Grain : std::uint8_t { kPixel, kLine, kTile };
enum class ShadowMode : std::uint8_t { kHorizon, kForward, kLocal };
enum class PartitionMode : std::uint8_t { kRegular, kBalanced, kAuto };
enum class FlowMode : std::uint8_t { kCredit, kBlocking };
/// Where a node's queue of received rays lies if flow is blocking: in the node's own process, which
/// has threads for links and for evaluators, or in a process apart.
enum class FifoMode : std::uint8_t { kThread, kProcess };
/// How contributions reach the frontal: from each node by itself, or added up along the hypercube's
/// tree, or along the ring.
enum class SumsMode : std::uint8_t { kDirect, kTree, kRing };
/// How light gets from where it is made to the frontal: straight, weighted by the rays' weights, or
/// back along the rays' ways to the node that sent the primary ray.
enum class ReturnsMode : std::uint8_t { kFrontal, kSender };
/// Whether the boundaries between macro-regions stay, or slide from busy nodes towards idle ones
/// while the picture is rendered.
enum class BoundariesMode : std::uint8_t { kFixed, kSliding };
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

/// Names as on the wire and on the command line; empty for values that the enum doesn't have.
std::string_view to_string(Algorithm value);
std::string_view to_string(Grain value);
std::string_view to_string(ShadowMode value);
std::string_view to_string(PartitionMode value);
std::string_view to_string(FlowMode value);
std::string_view to_string(FifoMode value);
std::string_view to_string(SumsMode value);
std::string_view to_string(MeshMode value);
std::string_view to_string(ReturnsMode value);
std::string_view to_string(BoundariesMode value);
std::string_view to_string(Subdivision value);
std::string_view to_string(Entry value);
std::string_view to_string(JobState value);
std::string_view to_string(NodeState value);
std::string_view to_string(FailureCode value);

/// JSON text of one object, carried as it is.
struct RawObject {
  std::string text = "{}";
  friend bool operator==(const RawObject&, const RawObject&) = default;
};

namespace control {

/// A node's record of one job: the fields of `per_node` in the statistics file, and those that the
/// frontal sums.
struct NodeStats {
  std::uint32_t rank = 0, gray = 0;
  std::uint64_t pid = 0;
  double cpu_s = 0, busy_s = 0, idle_s = 0, blocked_s = 0, window_s = 0;
  /// The part of cpu_s that the process took before its first job came; 0 in later jobs.
  double start_cpu_s = 0;
  /// Where the FIFO is a process apart: seconds for which the evaluator waited for it to hand out a
  /// ray, the part of cpu_s that it took, and messages between it and the node.
  double fifo_wait_s = 0, fifo_cpu_s = 0;
  std::uint64_t fifo_messages = 0;
  std::uint64_t rays_in = 0, rays_out = 0, queue_peak = 0, primitives = 0, peak_rss_bytes = 0;
  /// Numbers of rays, counted where the rays are created.
  std::uint64_t primary = 0, shadow = 0, reflection = 0, refraction = 0;
  std::uint64_t skipped_by_horizon = 0, forwarded_shadow = 0, forwarded_secondary = 0;
  /// Primary rays that went on to other nodes, before their first hit.
  std::uint64_t forwarded_primary = 0;
  std::uint64_t ray_batches = 0, ray_bytes = 0, contribution_batches = 0, contribution_bytes = 0;
  /// Contributions sent to the parent in the tree of sums; those above went to the frontal.
  std::uint64_t sum_batches = 0, sum_bytes = 0;
  /// Components of contributions mended while rounding; and batches and messages refused.
  std::uint64_t non_finite = 0, clamped = 0, malformed_drops = 0;
  /// The most rays that lay in the outboxes at one time.
  std::uint64_t outbox_peak = 0;
  /// Bytes of the model and its subdivision, borrowed models and copies included.
  std::uint64_t memory_bytes = 0;
  /// Other nodes' models that came here, to finish shadow rays or to help those nodes.
  std::uint64_t models_borrowed = 0;
  /// Other nodes' tiles, and rays that other nodes had received, that were traced here.
  std::uint64_t tiles_taken_over = 0, rays_taken_over = 0;
  /// Leaf regions, or items of a surface tree, of the node's own part of the scene.
  std::uint64_t cells = 0;
  /// What the search for crossings did, as WalkCounts says.
  std::uint64_t cells_visited = 0, primitives_tested = 0, tests_saved = 0;
  std::uint64_t boxes_tested = 0, boxes_rejected = 0, spheres_tested = 0, spheres_rejected = 0;
  std::uint64_t nodes_descended = 0, entry_links = 0, rays_not_shot = 0;
  /// Where light goes back along the rays' ways: the most rays and pixels that were open at a time,
  /// and the bytes that they took.
  std::uint64_t open_peak = 0, open_bytes_peak = 0;
  /// Rays of neighbours that were answered, and what the answers took.
  std::uint64_t answers = 0, answer_batches = 0, answer_bytes = 0;
  /// Parts of slices that were sent to neighbours.
  std::uint64_t slice_batches = 0, slice_bytes = 0;
  /// Seconds from the end of the node's last primary ray to its report.
  double endgame_s = 0;
  friend bool operator==(const NodeStats&, const NodeStats&) = default;
};

/// A render's options; those that a client leaves out keep the default.
struct JobOptions {
  Algorithm algorithm = Algorithm::kAuto;
  Grain grain = Grain::kTile;
  ShadowMode shadows = ShadowMode::kHorizon;
  PartitionMode partition = PartitionMode::kAuto;
  /// K, for K × K macro-regions per node; 0 picks what suits the scene.
  std::uint32_t scatter = 0;
  FlowMode flow = FlowMode::kCredit;
  /// Rays that a node's input queues hold together if flow is blocking.
  std::uint32_t queue = kDefaultQueue;
  FifoMode fifo = FifoMode::kThread;
  /// Evaluator threads per node; 0 for as many as the node was started with.
  std::uint32_t threads = 0;
  /// Seconds after which the job fails; 0 for no limit.
  double timeout_s = 0;
  /// Those that are absent are the scene's own values.
  std::optional<std::uint32_t> width{}, height{}, samples{}, max_depth{};
  /// Names of AOVs as parse_aovs reads them.
  std::string aov{};
  SumsMode sums = SumsMode::kDirect;
  SubdivisionChoice subdivision{};
  ReturnsMode returns = ReturnsMode::kFrontal;
  MeshMode mesh = MeshMode::k2d;
  BoundariesMode boundaries = BoundariesMode::kFixed;
  friend bool operator==(const JobOptions&, const JobOptions&) = default;
};

/// How light is added up in such a job: rings and trees bring their own sums along.
constexpr SumsMode sums_of(const JobOptions& options) {
  if (options.mesh == MeshMode::kRing) return SumsMode::kRing;
  return options.mesh == MeshMode::kTree ? SumsMode::kTree : options.sums;
}

/// The grid of macro-regions: `scatter` × `scatter` per node, region (i, j) on node
/// (i mod columns/scatter, j mod rows/scatter).
struct GridLayout {
  std::uint32_t columns = 1, rows = 1, scatter = 1;
  /// Inner boundaries as pixel edges, strictly increasing, one fewer than columns or rows.
  std::vector<std::int64_t> column_edges{}, row_edges{};
  /// Row by row, the boundaries between the pixels whose primary rays the row's nodes trace, one
  /// fewer than columns. Empty if these are the macro-regions' boundaries.
  std::vector<std::int64_t> own_edges{};
  /// In a 3D mesh, of each slab but the last, where it ends: scene units along the view. Slabs are
  /// not scattered.
  std::vector<double> slab_depths{};
  friend bool operator==(const GridLayout&, const GridLayout&) = default;
};

struct TokenProgress {
  std::uint32_t round = 0, hops = 0;
  friend bool operator==(const TokenProgress&, const TokenProgress&) = default;
};

struct ErrorItem {
  /// The place of the mistake: a JSON pointer into the scene, a node, or an option.
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
  /// The name of its host; empty where there is none yet.
  std::string host{};
  friend bool operator==(const NodeInfo&, const NodeInfo&) = default;
};

/// A machine that runs nodes.
struct HostInfo {
  std::string host{};
  std::uint32_t cores = 1;
  std::uint64_t memory_bytes = 0;
  /// Nodes that it is meant for, and those that it has.
  std::uint32_t slots = 1, nodes = 0;
  /// The process that starts its nodes.
  std::uint64_t pid = 0;
  /// For people: what it does, or why it gets no nodes.
  std::string state{};
  friend bool operator==(const HostInfo&, const HostInfo&) = default;
};

}  // namespace control
}  // namespace graycube
