// Control messages from the frontal to a node.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "proto/messages/values.hpp"

namespace graycube::control {

struct Welcome {
  static constexpr std::string_view kType = "welcome";
  std::uint32_t nodes = 1;
  /// The frontal's version.
  std::string version{};
  /// Endpoints of every node's inbox, indexed by rank; empty where no node is yet.
  std::vector<std::string> endpoints{};
  /// Milliseconds between the frontal's pings.
  std::uint32_t heartbeat_ms = 1000;
  friend bool operator==(const Welcome&, const Welcome&) = default;
};

/// A binary frame follows: the node's model slice, and at its end `horizon_bytes` of light
/// horizons. In the meshes ring and tree only rank 0 gets its slice so: the others' come over
/// links, once all nodes have answered with `epoch_ack`.
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
  /// Rays that the input queues hold together if flow is blocking. Nodes have no use for it: each
  /// link's part of it is link_credit_bytes.
  std::uint32_t queue = kDefaultQueue;
  FifoMode fifo = FifoMode::kThread;
  std::uint64_t link_credit_bytes = 0;
  /// Own tiles that may be open at a time. Nodes have no use for it: the frontal hands out no more.
  std::uint32_t window_tiles = 1;
  std::uint32_t batch_bytes = 65536;
  /// A node whose outboxes hold so many rays is full: it traces only rays on class credit. There is
  /// no bound if the frontal leaves this out.
  std::uint64_t outbox_rays = 0xFFFF'FFFF;
  /// Rays of each class that a link has places for beside its credit.
  std::uint32_t class_places = 1;
  std::uint64_t horizon_bytes = 0;
  /// Bytes for other nodes' models, if shadow rays are finished by the nodes that created them.
  std::uint64_t borrow_bytes = 0;
  /// The slice is a replica of the whole model.
  bool is_replica = false;
  /// Nodes tell their neighbours when they have nothing to do, and may get copies of their slices.
  bool makes_copies = false;
  SumsMode sums = SumsMode::kDirect;
  /// How nodes find the crossings of rays.
  SubdivisionChoice subdivision{};
  ReturnsMode returns = ReturnsMode::kFrontal;
  MeshMode mesh = MeshMode::k2d;
  BoundariesMode boundaries = BoundariesMode::kFixed;
  friend bool operator==(const Load&, const Load&) = default;
};

/// Answers `borrow`. A binary frame with the slice follows, unless it is larger than the room.
struct Lend {
  static constexpr std::string_view kType = "lend";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Lend&, const Lend&) = default;
};

/// A binary frame follows: the slice of a neighbour, in which this node can trace the neighbour's
/// tiles and rays.
struct Copy {
  static constexpr std::string_view kType = "copy";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const Copy&, const Copy&) = default;
};

/// To rank 0, in the meshes ring and tree. A binary frame follows: the slice of node `rank`, which
/// is to be handed on along the ring or tree.
struct HandOn {
  static constexpr std::string_view kType = "hand_on";
  std::uint32_t job = 0, epoch = 0, rank = 0;
  friend bool operator==(const HandOn&, const HandOn&) = default;
};

/// Tells that neighbours have traced so many of the node's own tiles, which are whole.
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

/// A node or a batch was lost: asks to drop everything of epochs before this one, and to
/// acknowledge that.
struct Prepare {
  static constexpr std::string_view kType = "prepare";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const Prepare&, const Prepare&) = default;
};

/// All nodes are ready: tracing begins.
struct Start {
  static constexpr std::string_view kType = "start";
  std::uint32_t job = 0, epoch = 0;
  /// The nodes' start numbers, indexed by rank; links accept no others.
  std::vector<std::uint32_t> incarnations{};
  /// How many tiles of each node are not whole yet, indexed by rank: those that assignments bring,
  /// or that neighbours trace. Empty if all own tiles are.
  std::vector<std::uint32_t> open_tiles{};
  friend bool operator==(const Start&, const Start&) = default;
};

/// Asks the node to send its report and to drop the job.
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

/// No process can be started for another node: this node's process is to be that node, too, under
/// this start number.
struct Host {
  static constexpr std::string_view kType = "host";
  std::uint32_t rank = 0, incarnation = 0;
  friend bool operator==(const Host&, const Host&) = default;
};

struct Shutdown {
  static constexpr std::string_view kType = "shutdown";
  friend bool operator==(const Shutdown&, const Shutdown&) = default;
};

}  // namespace graycube::control
