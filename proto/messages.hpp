// The control messages: what goes as JSON between nodes, frontal and clients, one struct per
// message. FORMAT.md, "Control messages", is normative. `kType` is the message's name on the wire,
// the members' names are the fields' names (control_fields.hpp lists them with their limits). Times
// are in seconds; jobs count from 1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
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

// ---- node → frontal

struct Hello {
  static constexpr std::string_view kType = "hello";
  std::uint32_t rank = 0;
  std::uint64_t pid = 0;
  std::uint32_t incarnation = 0;
  /// Where the node's inbox listens.
  std::string endpoint{};
  std::uint32_t threads = 1;
  std::string version{};
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// The macro-region is subdivided.
struct Ready {
  static constexpr std::string_view kType = "ready";
  std::uint32_t job = 0, epoch = 0;
  std::uint64_t primitives = 0, objects = 0, leaves = 0;
  double build_s = 0;
  friend bool operator==(const Ready&, const Ready&) = default;
};

/// Everything of older epochs is dropped. Frontals that begin epochs wait for it; none does yet.
struct EpochAck {
  static constexpr std::string_view kType = "epoch_ack";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const EpochAck&, const EpochAck&) = default;
};

/// Rank 0 only: the token came round without ending the image.
struct TokenRound {
  static constexpr std::string_view kType = "token_round";
  std::uint32_t job = 0, epoch = 0, round = 0, hops = 0;
  bool black = false;
  std::int64_t count = 0;
  friend bool operator==(const TokenRound&, const TokenRound&) = default;
};

/// Rank 0 only: the token's verdict, with the contribution batches that the frontal must hold by
/// then.
struct Terminated {
  static constexpr std::string_view kType = "terminated";
  std::uint32_t job = 0, epoch = 0, rounds = 0, hops = 0;
  std::uint64_t contribution_batches = 0;
  friend bool operator==(const Terminated&, const Terminated&) = default;
};

struct NodeReport {
  static constexpr std::string_view kType = "node_report";
  std::uint32_t job = 0, epoch = 0;
  NodeStats stats{};
  friend bool operator==(const NodeReport&, const NodeReport&) = default;
};

struct Pong {
  static constexpr std::string_view kType = "pong";
  std::uint64_t sequence = 0;
  friend bool operator==(const Pong&, const Pong&) = default;
};

/// Flow blocking only, behind each pong: what the node waits for. The frontal finds cycles in
/// these.
struct WaitReport {
  static constexpr std::string_view kType = "wait_report";
  std::uint32_t job = 0, epoch = 0;
  /// The ping's sequence.
  std::uint64_t ping = 0;
  /// The evaluator holds a ray for which the queue across bit `waits_for` has no room.
  bool is_stalled = false;
  std::uint32_t waits_for = 0;
  /// Pieces of work done so far.
  std::uint64_t moves = 0;
  /// Rays' room granted to, and received from, the neighbour across each bit.
  std::vector<std::uint64_t> granted{}, received{};
  friend bool operator==(const WaitReport&, const WaitReport&) = default;
};

/// Asks for another node's model slice, to finish shadow rays.
struct Borrow {
  static constexpr std::string_view kType = "borrow";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  /// Largest slice that the node has room for.
  std::uint64_t room_bytes = 0;
  friend bool operator==(const Borrow&, const Borrow&) = default;
};

/// A neighbour that has nothing to do is to get a copy of this node's slice, to help it.
struct Share {
  static constexpr std::string_view kType = "share";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Share&, const Share&) = default;
};

/// The node can't go on with a job. job 0: with anything.
struct NodeError {
  static constexpr std::string_view kType = "node_error";
  std::uint32_t job = 0;
  std::string message{};
  friend bool operator==(const NodeError&, const NodeError&) = default;
};

/// Nothing more will come from this node.
struct Goodbye {
  static constexpr std::string_view kType = "goodbye";
  friend bool operator==(const Goodbye&, const Goodbye&) = default;
};

// ---- frontal → node

struct Welcome {
  static constexpr std::string_view kType = "welcome";
  std::uint32_t nodes = 1;
  /// The frontal's.
  std::string version{};
  /// Every node's inbox, by rank; empty where no node is yet.
  std::vector<std::string> endpoints{};
  /// How often the frontal pings.
  std::uint32_t heartbeat_ms = 1000;
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

/// Followed by a binary frame: the node's model slice, and behind it `horizon_bytes` of light
/// horizons.
struct Load {
  static constexpr std::string_view kType = "load";
  std::uint32_t job = 0, epoch = 0;
  /// kRoth or kMacro.
  Algorithm algorithm = Algorithm::kMacro;
  std::uint32_t threads = 1;
  GridLayout grid{};
  Grain grain = Grain::kTile;
  /// Side of a tile, in pixels.
  std::uint32_t tile_size = 1;
  ShadowMode shadows = ShadowMode::kHorizon;
  FlowMode flow = FlowMode::kCredit;
  /// Rays that the input queues hold together where flow is blocking. Nodes have no use for it:
  /// each link's part of it is link_credit_bytes.
  std::uint32_t queue = kDefaultQueue;
  std::uint64_t link_credit_bytes = 0;
  /// Own tiles that may be open at a time. Nodes have no use for it: the frontal hands out no more.
  std::uint32_t window_tiles = 1;
  std::uint32_t batch_bytes = 65536;
  /// A node whose outboxes hold so many rays is full: it traces only what comes on class credit.
  /// Where a frontal says nothing there is no bound.
  std::uint64_t outbox_rays = 0xFFFF'FFFF;
  /// Rays of each class that a link has places for beside its credit.
  std::uint32_t class_places = 1;
  std::uint64_t horizon_bytes = 0;
  /// Memory for other nodes' models, where shadow rays are finished by the node that created them.
  std::uint64_t borrow_bytes = 0;
  /// The slice is a replica of the whole model.
  bool is_replica = false;
  /// Nodes tell their neighbours when they have nothing to do, and may get copies of their slices.
  bool makes_copies = false;
  SumsMode sums = SumsMode::kDirect;
  friend bool operator==(const Load&, const Load&) = default;
};

/// Answers `borrow`; followed by a binary frame with the slice, unless it is larger than the room.
struct Lend {
  static constexpr std::string_view kType = "lend";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Lend&, const Lend&) = default;
};

/// Followed by a binary frame: the slice of a neighbour, which its tiles and rays can be traced in
/// here.
struct Copy {
  static constexpr std::string_view kType = "copy";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Copy&, const Copy&) = default;
};

/// So many of the node's own tiles were traced by neighbours, and are whole.
struct Relieved {
  static constexpr std::string_view kType = "relieved";
  std::uint32_t job = 0, epoch = 0, tiles = 1;
  friend bool operator==(const Relieved&, const Relieved&) = default;
};

/// To rank 0: all tiles are whole, so that no ray is left anywhere.
struct AllWhole {
  static constexpr std::string_view kType = "all_whole";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const AllWhole&, const AllWhole&) = default;
};

/// Drop everything of epochs before this one, and acknowledge. Nodes do; no frontal sends it yet,
/// since a job fails with a node. One that has a lost node replaced will.
struct Prepare {
  static constexpr std::string_view kType = "prepare";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const Prepare&, const Prepare&) = default;
};

/// The barrier is passed. Tiles to trace: a node's own in epoch 0, later those that assignments
/// bring.
struct Start {
  static constexpr std::string_view kType = "start";
  std::uint32_t job = 0, epoch = 0;
  /// By rank; links accept no others.
  std::vector<std::uint32_t> incarnations{};
  friend bool operator==(const Start&, const Start&) = default;
};

/// Send the report and drop the job.
struct Finish {
  static constexpr std::string_view kType = "finish";
  std::uint32_t job = 0;
  friend bool operator==(const Finish&, const Finish&) = default;
};

struct Ping {
  static constexpr std::string_view kType = "ping";
  std::uint64_t sequence = 0;
  friend bool operator==(const Ping&, const Ping&) = default;
};

struct Shutdown {
  static constexpr std::string_view kType = "shutdown";
  friend bool operator==(const Shutdown&, const Shutdown&) = default;
};

// ---- client → frontal

/// Followed by a binary frame: the scene's text.
struct Submit {
  static constexpr std::string_view kType = "submit";
  std::string scene_name{};
  JobOptions options{};
  friend bool operator==(const Submit&, const Submit&) = default;
};

struct Status {
  static constexpr std::string_view kType = "status";
  std::uint32_t job = 0;
  friend bool operator==(const Status&, const Status&) = default;
};

struct List {
  static constexpr std::string_view kType = "list";
  friend bool operator==(const List&, const List&) = default;
};

/// Progress from now on, until Done or Failed.
struct Watch {
  static constexpr std::string_view kType = "watch";
  std::uint32_t job = 0;
  friend bool operator==(const Watch&, const Watch&) = default;
};

struct Cancel {
  static constexpr std::string_view kType = "cancel";
  std::uint32_t job = 0;
  friend bool operator==(const Cancel&, const Cancel&) = default;
};

struct Nodes {
  static constexpr std::string_view kType = "nodes";
  friend bool operator==(const Nodes&, const Nodes&) = default;
};

/// Rows of a picture; fewer may come, the client asks on from there. Plane 0 is light, 1 …
/// kAovPlanes are those of AOVs.
struct Fetch {
  static constexpr std::string_view kType = "fetch";
  std::uint32_t job = 0, first_row = 0, rows = 0, plane = 0;
  friend bool operator==(const Fetch&, const Fetch&) = default;
};

/// To a private frontal: write a picture's files, "" for none. For pictures of at most
/// kMostPixelsToWrite.
struct Write {
  static constexpr std::string_view kType = "write";
  std::uint32_t job = 0;
  /// Absolute paths.
  std::string exr{}, png{};
  friend bool operator==(const Write&, const Write&) = default;
};

/// Stop the farm.
struct Down {
  static constexpr std::string_view kType = "down";
  friend bool operator==(const Down&, const Down&) = default;
};

// ---- frontal → client

struct Accepted {
  static constexpr std::string_view kType = "accepted";
  std::uint32_t job = 0;
  friend bool operator==(const Accepted&, const Accepted&) = default;
};

struct JobInfo {
  static constexpr std::string_view kType = "job_info";
  std::uint32_t job = 0;
  JobState state = JobState::kQueued;
  std::string scene{};
  Algorithm algorithm = Algorithm::kAuto;
  std::uint32_t nodes = 0;
  /// 0 … 1.
  double fraction = 0;
  /// Absent while nothing is known.
  std::optional<double> eta_s{};
  std::uint32_t rounds = 0;
  /// Unix time.
  double submitted_s = 0;
  std::optional<double> started_s{}, finished_s{};
  std::string message{};
  std::uint32_t tiles = 0, tiles_whole = 0;
  /// What was picked for the scene, for people; empty until then.
  std::string choices{};
  friend bool operator==(const JobInfo&, const JobInfo&) = default;
};

/// The newest kMaxJobsListed jobs.
struct Jobs {
  static constexpr std::string_view kType = "jobs";
  std::vector<JobInfo> jobs{};
  friend bool operator==(const Jobs&, const Jobs&) = default;
};

struct Progress {
  static constexpr std::string_view kType = "progress";
  std::uint32_t job = 0;
  JobState state = JobState::kQueued;
  double fraction = 0;
  std::optional<double> eta_s{};
  std::uint32_t tiles_whole = 0, tiles = 0, rounds = 0;
  std::optional<TokenProgress> token{};
  friend bool operator==(const Progress&, const Progress&) = default;
};

struct NodeList {
  static constexpr std::string_view kType = "node_list";
  std::vector<NodeInfo> nodes{};
  friend bool operator==(const NodeList&, const NodeList&) = default;
};

struct Done {
  static constexpr std::string_view kType = "done";
  std::uint32_t job = 0;
  /// The statistics file.
  RawObject stats{};
  friend bool operator==(const Done&, const Done&) = default;
};

/// Followed by a binary frame: `rows` rows of `width` pixels, see picture_rows.hpp.
struct Picture {
  static constexpr std::string_view kType = "picture";
  std::uint32_t job = 0, width = 1, height = 1, first_row = 0, rows = 0, plane = 0;
  /// The AOVs that the picture has.
  std::string aov{};
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// The files are there, each whole.
struct Written {
  static constexpr std::string_view kType = "written";
  std::uint32_t job = 0, width = 1, height = 1;
  /// What writing took of the frontal's CPU time, which the statistics can't have.
  double cpu_s = 0;
  friend bool operator==(const Written&, const Written&) = default;
};

/// Refusals and failed jobs; job 0 when the request named none.
struct Failed {
  static constexpr std::string_view kType = "failed";
  std::uint32_t job = 0;
  FailureCode code = FailureCode::kFailed;
  std::vector<ErrorItem> errors{};
  /// Of a job that ended in a deadlock: the statistics file.
  std::optional<RawObject> stats{};
  friend bool operator==(const Failed&, const Failed&) = default;
};

/// The frontal stops.
struct Bye {
  static constexpr std::string_view kType = "bye";
  friend bool operator==(const Bye&, const Bye&) = default;
};

}  // namespace control

using ControlMessage = std::variant<
    control::Hello, control::Ready, control::EpochAck, control::TokenRound, control::Terminated,
    control::NodeReport, control::Pong, control::NodeError, control::WaitReport, control::Borrow,
    control::Share, control::Goodbye, control::Welcome, control::Load, control::Lend, control::Copy,
    control::Relieved, control::AllWhole, control::Prepare, control::Start, control::Finish,
    control::Ping, control::Shutdown, control::Submit, control::Status, control::List,
    control::Watch, control::Cancel, control::Nodes, control::Fetch, control::Write, control::Down,
    control::Accepted, control::JobInfo, control::Jobs, control::Progress, control::NodeList,
    control::Done, control::Picture, control::Written, control::Failed, control::Bye>;

}  // namespace graycube
