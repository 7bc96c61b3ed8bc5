#include "frontal/preparation/preparation.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>

#include "check.hpp"
#include "formats/graycube/read_scene.hpp"
#include "frontal/preparation/choice.hpp"
#include "frontal/preparation/partition.hpp"
#include "frontal/preparation/slices.hpp"
#include "proto/horizon_bytes.hpp"
#include "proto/job_settings.hpp"
#include "proto/model_slice.hpp"
#include "regions/macro_grid.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene_fault.hpp"
#include "shading/credit_limits.hpp"
#include "trace/tile_lines.hpp"
#include "visibility/light_depths.hpp"

namespace graycube {
namespace {

/// Scatter when none is asked for. Each doubling about doubles the rays that are forwarded, which
/// costs more than the better balance brings (docs/lab/2026-11-22-scattered-regions.md).
constexpr std::uint32_t kAutoScatter = 1;

/// Depths are made beside light horizons only if there are this many primary rays to each
/// primitive, as two more scenes are subdivided for them, and this many to each texel of depths.
constexpr std::uint64_t kRaysPerPrimitiveForDepths = 12;
constexpr std::uint64_t kRaysPerDepthTexel = 6;

/// Foreign bounds are made only if there are this many primary rays to each primitive, since they
/// are taken from the whole scene's tree.
constexpr std::uint64_t kRaysPerPrimitiveForBounds = 2;

/// Up to this size of the model, most nodes have room for all objects that their shadow rays meet.
constexpr std::uint64_t kFinishedModelBytes = 2 * kSmallSlices;

void add_error(std::vector<control::ErrorItem>& errors, std::string where, std::string why) {
  if (errors.size() < kMaxErrorsListed) errors.push_back({std::move(where), std::move(why)});
}

/// Checks limits that `serial` doesn't have.
void check_credit_limits(const RenderSettings& s, std::vector<control::ErrorItem>& errors) {
  for (const ExceededLimit& limit : exceeded_credit_limits(s)) {
    const std::string unit = limit.unit.empty() ? "" : " " + std::string(limit.unit);
    add_error(errors, std::string(limit.where),
              "roth and macro take at most " + std::to_string(limit.most) + unit + "; use serial");
  }
}

/// Checks the settings with the options' overrides; what doesn't fit is added to `errors`.
void check_overrides(const control::JobOptions& options, const RenderSettings& settings,
                     const Hypercube& cube, std::vector<control::ErrorItem>& errors) {
  const auto in_range = [&](const char* name, std::uint64_t value, std::uint64_t least,
                            std::uint64_t most) {
    if (value >= least && value <= most) return;
    add_error(errors, name,
              "expected " + std::to_string(least) + " to " + std::to_string(most) + ", found " +
                  std::to_string(value));
  };
  const ImageSize& image = settings.image;
  in_range("--size", image.width, 1, kMaxImageSide);
  in_range("--size", image.height, 1, kMaxImageSide);
  in_range("--size", std::uint64_t{image.width} * image.height, 1, kMaxPixels);
  in_range("--samples", image.samples, 1, kMaxSamples);
  in_range("--max-depth", settings.max_depth, 0, kMaxDepth);
  const NodeMesh mesh(cube, options.mesh);
  if (options.scatter != 0) {
    in_range("--scatter", options.scatter, 1,
             std::min(kMaxScatter, kMaxGridSide / std::max(mesh.columns(), mesh.rows())));
  }
  if (options.boundaries == BoundariesMode::kSliding) {
    if (options.shadows == ShadowMode::kLocal)
      add_error(errors, "--boundaries",
                "sliding goes with --shadows horizon and forward, not local");
    if (options.scatter > 1)
      add_error(errors, "--boundaries",
                "sliding goes with one macro-region for each node, not with --scatter");
    if (options.mesh != MeshMode::k2d)
      add_error(errors, "--boundaries",
                "sliding goes with --mesh 2d, not " + std::string(to_string(options.mesh)));
  }
  if (!parse_aovs(options.aov)) {
    add_error(errors, "--aov", "expected names of AOVs, each once, found " + options.aov);
  }
}

/// Nothing, and errors, when the bytes are no scene.
std::optional<Model> model_of(std::span<const std::byte> scene,
                              std::vector<control::ErrorItem>& errors) {
  if (is_encoded_model(scene)) {
    auto decoded = decode_model(scene);
    if (auto* model = std::get_if<Model>(&decoded)) return std::move(*model);
    const auto& error = std::get<ModelError>(decoded);
    add_error(errors, "", "the compiled scene is broken: " + error.where + ": " + error.why);
    return std::nullopt;
  }
  const ReadResult read = read_scene_text(text_of(scene));
  for (const SceneError& e : read.errors) add_error(errors, e.pointer, e.message);
  if (!read.scene) return std::nullopt;
  try {
    return compile_scene(*read.scene);
  } catch (const UnrenderableScene& e) {
    for (const SceneFault& f : e.faults()) add_error(errors, f.pointer, f.message);
    return std::nullopt;
  }
}

Algorithm chosen(const PreparationWork& work, const Model& model) {
  if (work.options.algorithm != Algorithm::kAuto) return work.options.algorithm;
  return chosen_algorithm(work.options.mesh, {.model_bytes = encoded_model_bytes(model),
                                              .primary_rays = model.settings.image.primary_rays(),
                                              .nodes = work.cube.nodes(),
                                              .hosts = work.hosts});
}

void cut_for_roth(const Model& model, const Hypercube& cube, PreparedScene& out) {
  const ImageSize& image = model.settings.image;
  const auto frame = CameraFrame::from(model.settings.camera, image);
  const MacroGrid grid = MacroGrid::regular(frame, cube.columns(), cube.rows());
  out.grid = {grid.columns(), grid.rows(), 1, grid.column_edges(), grid.row_edges(), {}, {}};
  out.plan.emplace(image, tile_shape(out.grain, kTileSide, image));
  out.slices.push_back(encode_model(model));
}

/// The knowledge of the shadow rays' ways to the lights that nodes get.
struct LightWays {
  std::shared_ptr<const LightHorizons> horizons;
  Occluders occluders;
  /// Most nodes hold all that shadow rays may meet.
  bool are_held = false;
};

/// Whether boundaries are asked to slide, where there are any. Then nodes hold only what their
/// macro-regions need, and help nobody: what goes beyond that would have to slide, too.
bool is_to_slide(const PreparationWork& work) {
  return work.options.boundaries == BoundariesMode::kSliding && work.cube.nodes() > 1;
}

/// Nothing when horizons aren't wanted or there are none: on one node no ray leaves, and lights
/// that are walled in have none. Depths are made only when too many shadow rays will leave their
/// nodes for want of room for occluders.
LightWays ways_to_lights(const PreparationWork& work, const WholeScene& whole) {
  LightWays ways;
  if (work.options.shadows != ShadowMode::kHorizon || work.cube.nodes() == 1) return ways;
  const Model& model = whole.model();
  if (work.options.flow == FlowMode::kCredit && !is_to_slide(work))
    ways.occluders = Occluders::of(model);
  LightHorizons horizons =
      ways.occluders.is_empty() ? LightHorizons::of(model) : ways.occluders.horizons();
  if (horizons.is_empty()) return {};
  if (!ways.occluders.is_empty() && encoded_model_bytes(model) <= kFinishedModelBytes) {
    ways.are_held = true;
  } else if (whole.has_primary_rays(kRaysPerPrimitiveForDepths)) {
    const std::uint64_t most_texels = model.settings.image.primary_rays() / kRaysPerDepthTexel;
    horizons = with_depths(std::move(horizons), *whole.territory()->tree, most_texels);
  }
  ways.horizons = std::make_shared<const LightHorizons>(std::move(horizons));
  return ways;
}

/// Whether nodes finish rays that have left their macro-regions. Not if a mode is asked for that
/// keeps to the report, nor if the whole scene would be subdivided for nothing else.
bool finishes_rays(const PreparationWork& work, const WholeScene& whole) {
  return work.options.shadows == ShadowMode::kHorizon && work.options.flow == FlowMode::kCredit &&
         work.cube.nodes() > 1 && !is_to_slide(work) &&
         whole.has_primary_rays(kRaysPerPrimitiveForBounds);
}

/// The partition mode with kAuto decided where it can be. Balance matters when rays wait for the
/// busiest node: not when nodes have replicas, nor in the flow of 1987.
PartitionMode chosen_partition(const PreparationWork& work, bool has_replicas) {
  const bool is_open = work.options.partition == PartitionMode::kAuto;
  return is_open && (has_replicas || work.options.flow == FlowMode::kBlocking)
             ? PartitionMode::kRegular
             : work.options.partition;
}

/// Sides of tiles where boundaries slide, as these lie between tiles: the smaller one where
/// macro-regions would have fewer tiles than this across.
constexpr std::uint32_t kSlidingTileSide = 8, kSmallSlidingTileSide = 4;
constexpr std::uint32_t kTilesAcrossRegion = 4;

std::uint32_t sliding_tile_side(const ImageSize& image, const MacroGrid& grid) {
  const std::uint32_t least = std::min(image.width / grid.columns(), image.height / grid.rows());
  return least < kTilesAcrossRegion * kSlidingTileSide ? kSmallSlidingTileSide : kSlidingTileSide;
}

/// Whether every macro-region has tiles and there is a place to slide to: not in tiny pictures.
bool can_slide(const TilePlan& plan, const MacroGrid& grid) {
  const TileLines lines = TileLines::of(plan);
  const auto cuts = lines.cuts_of(grid);
  return cuts && lines.has_room(*cuts);
}

void cut_for_macro(const PreparationWork& work, const WholeScene& whole, PreparedScene& out) {
  const Model& model = whole.model();
  const std::uint32_t k = work.options.scatter != 0 ? work.options.scatter : kAutoScatter;
  out.shadows = work.options.shadows;
  out.flow = work.options.flow;
  out.queue = work.options.queue;
  if (out.flow == FlowMode::kBlocking) out.fifo = work.options.fifo;
  out.returns = work.options.returns;
  out.mesh = work.options.mesh;
  const NodeMesh mesh(work.cube, out.mesh);
  const bool is_local = out.shadows == ShadowMode::kLocal && out.flow == FlowMode::kCredit;
  out.has_replicas =
      is_local && work.cube.nodes() > 1 && encoded_model_bytes(model) <= work.replica_bytes;
  const LightWays ways = ways_to_lights(work, whole);
  Bytes horizons;
  if (ways.horizons) {
    horizons = encode_horizons(*ways.horizons);
    out.horizon_bytes = horizons.size();
  } else if (out.shadows == ShadowMode::kHorizon) {
    out.shadows = ShadowMode::kForward;
  }
  const bool finishes = finishes_rays(work, whole);
  Partition cut =
      partition_of(whole, mesh, k, chosen_partition(work, out.has_replicas), ways.horizons,
                   {.shadow_rays = ways.are_held, .secondary_rays = finishes});
  out.makes_copies = work.options.partition == PartitionMode::kAuto && !out.has_replicas &&
                     work.cube.nodes() > 1 && out.flow == FlowMode::kCredit &&
                     out.shadows != ShadowMode::kLocal && !is_to_slide(work);
  out.partition = cut.mode;
  out.rays_per_primary = cut.rays_per_primary;
  if (out.has_replicas) {
    out.slices.push_back(encode_model(model));
  } else {
    out.copy_room = copy_room(encoded_model_bytes(model), work.cube.nodes());
    const SurfaceTree* tree = finishes ? &*whole.territory()->tree : nullptr;
    Slices slices = slices_of(model, mesh, cut, tree, ways.occluders, horizons);
    out.slices = std::move(slices.bytes);
    // Rays that begin beside a node's macro-region would all leave it at once.
    if (!slices.have_bounds) cut.own_edges.clear();
  }
  const MacroGrid& grid = cut.grid;
  out.grid = {grid.columns(), grid.rows(),       k, grid.column_edges(), grid.row_edges(),
              cut.own_edges,  grid.slab_depths()};
  if (is_to_slide(work)) out.tile_side = sliding_tile_side(model.settings.image, grid);
  out.plan.emplace(model.settings.image, tile_shape(out.grain, out.tile_side, model.settings.image),
                   grid, cut.own_edges);
  if (is_to_slide(work) && can_slide(*out.plan, grid)) {
    out.boundaries = BoundariesMode::kSliding;
    out.model = whole.shared_model();
  }
}

}  // namespace

std::string choices_text(const PreparedScene& scene) {
  std::string subdivision;
  if (scene.subdivision.way != Subdivision::kSurfaces)
    subdivision = ", " + std::string(to_string(scene.subdivision.way)) + " subdivision";
  if (scene.algorithm != Algorithm::kMacro) {
    return "grain " + std::string(to_string(scene.grain)) + subdivision;
  }
  std::string text = "scatter " + std::to_string(scene.grid.scatter) + ", " +
                     std::string(to_string(scene.shadows)) + " shadows, " +
                     std::string(to_string(scene.partition)) + " partition";
  if (scene.has_replicas || scene.makes_copies) text += ", neighbours help";
  if (scene.mesh != MeshMode::k2d) text += ", mesh " + std::string(to_string(scene.mesh));
  if (scene.boundaries == BoundariesMode::kSliding) text += ", sliding boundaries";
  if (scene.returns == ReturnsMode::kSender) text += ", light back to senders";
  if (scene.flow == FlowMode::kBlocking) {
    text += ", blocking queues of " + std::to_string(scene.queue);
    if (scene.fifo == FifoMode::kProcess) text += " in processes apart";
  }
  return text + subdivision;
}

namespace {

/// Nothing, and an error, when it can't be read.
std::optional<SharedBytes> scene_of(const PreparationWork& work, PreparationResult& result) {
  if (!work.read_scene) return work.scene;
  try {
    return work.read_scene();
  } catch (const std::runtime_error& e) {
    add_error(result.errors, "the job store", e.what());
    result.is_internal = true;
    return std::nullopt;
  }
}

void prepare_into(PreparationResult& result, const PreparationWork& work,
                  const std::function<double()>& clock_s) {
  const double began_s = clock_s();
  const auto text = scene_of(work, result);
  if (!text) return;
  auto whole = model_of(*text, result.errors);
  if (!whole) return;
  Model& model = *whole;
  apply_overrides(work.options, model.settings);
  check_overrides(work.options, model.settings, work.cube, result.errors);
  check_credit_limits(model.settings, result.errors);
  if (result.errors.empty() && !fits_model_limits(model)) {
    add_error(result.errors, "", "the scene is larger than a farm takes; use serial");
  }
  if (!result.errors.empty()) return;
  PreparedScene& scene = result.scene.emplace();
  const double loaded_s = clock_s();
  scene.load_s = loaded_s - began_s;
  scene.algorithm = chosen(work, model);
  scene.grain = scene.algorithm == Algorithm::kRoth ? work.options.grain : Grain::kTile;
  scene.settings = model.settings;
  scene.subdivision = work.options.subdivision;
  scene.primitives = model.primitives.size();
  scene.objects = model.objects.size();
  if (scene.algorithm == Algorithm::kRoth) {
    cut_for_roth(model, work.cube, scene);
  } else {
    cut_for_macro(work, WholeScene(std::make_shared<const Model>(std::move(model))), scene);
  }
  scene.partition_s = clock_s() - loaded_s;
}

}  // namespace

PreparationResult prepare(const PreparationWork& work, const std::function<double()>& clock_s) {
  PreparationResult result;
  const auto fail = [&](const std::string& why) {
    result.scene.reset();
    result.errors = {{work.scene_name, why}};
    result.is_internal = true;
  };
  try {
    const ChecksThrow checks_throw;
    prepare_into(result, work, clock_s);
  } catch (const std::bad_alloc&) {
    fail("there is not enough memory to prepare it");
  } catch (const std::exception& e) {
    fail(std::string("internal error: ") + e.what());
  }
  result.job = work.job;
  return result;
}

}  // namespace graycube
