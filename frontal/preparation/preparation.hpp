// Turns a scene's text into the nodes' slices: reads, compiles and cuts it into macro-regions, each
// with only the part that reaches into it. Pure and slow: a thread of its own runs it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.hpp"
#include "topology/hypercube.hpp"
#include "trace/tile_plan.hpp"
#include "transport/message.hpp"

namespace graycube {

struct Model;

/// With `--shadows local`, a model of at most so many bytes is sent to every node whole, as every
/// node will need nearly all of it.
inline constexpr std::uint64_t kReplicaBytes = std::uint64_t{32} << 20;

struct PreparationWork {
  std::uint32_t job = 0;
  std::string scene_name;
  /// The scene's text, or the model that the client has compiled it to.
  SharedBytes scene;
  /// What reads it, if it isn't here yet; throws std::runtime_error.
  std::function<SharedBytes()> read_scene{};
  control::JobOptions options;
  Hypercube cube = *Hypercube::of_size(1);
  std::uint64_t replica_bytes = kReplicaBytes;
  /// Hosts that the nodes lie on.
  std::uint32_t hosts = 1;
};

struct PreparedScene {
  Algorithm algorithm = Algorithm::kMacro;
  control::GridLayout grid;
  Grain grain = Grain::kTile;
  ShadowMode shadows = ShadowMode::kForward;
  PartitionMode partition = PartitionMode::kRegular;
  FlowMode flow = FlowMode::kCredit;
  FifoMode fifo = FifoMode::kThread;
  SubdivisionChoice subdivision;
  ReturnsMode returns = ReturnsMode::kFrontal;
  MeshMode mesh = MeshMode::k2d;
  BoundariesMode boundaries = BoundariesMode::kFixed;
  std::uint32_t queue = kDefaultQueue;
  RenderSettings settings;
  /// Side of a tile in pixels.
  std::uint32_t tile_side = kTileSide;
  std::optional<TilePlan> plan;
  /// The whole model, from which slices are cut anew; null unless boundaries slide.
  std::shared_ptr<const Model> model;
  std::uint64_t primitives = 0, objects = 0;
  /// Slices with light horizons at their ends, by rank; or one for all, the whole model.
  std::vector<SharedBytes> slices;
  /// Bytes that slices may take on each node, copies of neighbours' slices included.
  std::uint64_t copy_room = 0;
  /// Bytes of light horizons at the end of each slice.
  std::uint64_t horizon_bytes = 0;
  /// In `macro`: every node holds the whole model.
  bool has_replicas = false;
  /// In `macro`: nodes that run dry may get copies of their neighbours' slices, to help them.
  bool makes_copies = false;
  /// The rays that descend from a primary ray, itself included, on average; 0 where nothing tells.
  double rays_per_primary = 0;
  /// Seconds that reading and compiling the scene took, and seconds that cutting it took.
  double load_s = 0, partition_s = 0;
};

struct PreparationResult {
  std::uint32_t job = 0;
  std::optional<PreparedScene> scene;
  /// The scene file's mistakes, or options that don't fit it.
  std::vector<control::ErrorItem> errors;
  /// Whether the error isn't the scene's fault: this program's, or for want of memory.
  bool is_internal = false;
};

/// What was picked for the scene, for people: "scatter 4, horizon shadows".
std::string choices_text(const PreparedScene& scene);

/// `clock_s` tells seconds, of which only differences count. Checks that fail on the way are errors
/// of this job alone; nothing is thrown but WorkStopped (stop_point.hpp).
PreparationResult prepare(const PreparationWork& work, const std::function<double()>& clock_s);

}  // namespace graycube
