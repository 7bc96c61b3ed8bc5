// Meshes on simulated farms, by seed: whatever the mesh and the delays, the picture is the serial
// one; and slices and light go along the links of rings and trees.
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr MeshMode kMeshes[] = {MeshMode::k3d, MeshMode::kRing, MeshMode::kTree};

/// One seed's trial, with more nodes than others have, so that there are slabs.
Trial trial_of_mesh(std::uint64_t seed, MeshMode mesh) {
  Trial t = trial_of(seed);
  t.job.algorithm = Algorithm::kMacro;
  t.job.mesh = mesh;
  if (t.farm.nodes < 8 && !t.is_square) t.farm.nodes = 8u << seed % 2;
  if (seed % 5 == 0) t.job.returns = ReturnsMode::kSender;
  return t;
}

}  // namespace

TEST_CASE(
    "nodes in any mesh give the serial picture in every way of working, whatever the delays") {
  constexpr std::uint64_t kSeeds = 450;
  const std::string small = tiny_scene(12, 8), square = tiny_scene(16, 16);
  const Picture expected[] = {serial_picture(small), serial_picture(square)};
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::map<MeshMode, std::uint64_t> rays, primary, done;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    const MeshMode mesh = kMeshes[seed % std::size(kMeshes)];
    const Trial t = trial_of_mesh(seed, mesh);
    INFO("seed " << seed << ": " << t.name() << ", mesh " << to_string(mesh) << ", " << t.farm.nodes
                 << " nodes, scatter " << t.job.scatter);
    RandomFarm farm(t.farm);
    const Outcome outcome = farm.render(t.is_square ? square : small, t.job);
    if (t.job.flow == FlowMode::kBlocking && outcome.failed) {
      CHECK(outcome.failed->code == FailureCode::kDeadlock);
      continue;
    }
    check_same_picture(farm, outcome, 1, expected[t.is_square ? 1 : 0]);
    ++done[mesh];
    rays[mesh] += total(outcome, &control::NodeStats::rays_in);
    primary[mesh] += total(outcome, &control::NodeStats::forwarded_primary);
  }
  if (only != 0 || last < kSeeds) return;
  for (const MeshMode mesh : kMeshes) {
    CHECK(done[mesh] > 100);
    CHECK(rays[mesh] > 10'000);
    CHECK((primary[mesh] > 1000) == (mesh == MeshMode::k3d));
  }
}

TEST_CASE("slabs go together with AOVs, samples, help and what is known of other nodes' objects") {
  std::uint64_t primary = 0, taken_over = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::string text = scene_text(seed % 2 == 0 ? 144 : 48, seed % 2 == 0 ? 96 : 32);
    RandomFarmOptions how{.nodes = 8u << (seed % 2),
                          .threads = static_cast<std::uint32_t>(1 + seed % 3),
                          .seed = seed};
    how.limits.window_tiles = 1 + static_cast<std::uint32_t>(seed % 3);
    control::JobOptions options = with(Algorithm::kMacro);
    options.mesh = MeshMode::k3d;
    options.partition = seed % 5 == 0 ? PartitionMode::kRegular : PartitionMode::kAuto;
    options.shadows = seed % 3 == 0 ? ShadowMode::kHorizon : ShadowMode::kForward;
    options.aov = "depth,normal,albedo,object";
    INFO("seed " << seed << ", " << how.nodes << " nodes");
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, serial_picture(text, AovSet::all()));
    primary += total(outcome, &control::NodeStats::forwarded_primary);
    taken_over += total(outcome, &control::NodeStats::tiles_taken_over) +
                  total(outcome, &control::NodeStats::rays_taken_over);
  }
  CHECK(primary > 1000);
  CHECK(taken_over > 100);
}

TEST_CASE("each slice and all light cross the links of a ring or tree alone") {
  const std::string text = scene_text(48, 32);
  for (const MeshMode mesh : {MeshMode::k2d, MeshMode::kRing, MeshMode::kTree}) {
    for (const std::uint32_t nodes : {1u, 2u, 8u, 16u}) {
      INFO("mesh " << to_string(mesh) << ", " << nodes << " nodes");
      control::JobOptions options = with(Algorithm::kMacro);
      options.mesh = mesh;
      options.shadows = ShadowMode::kForward;
      options.partition = PartitionMode::kRegular;
      RandomFarm farm({.nodes = nodes});
      const Outcome outcome = farm.render(text, options);
      check_same_picture(farm, outcome, 1, serial_picture(text));
      // Without horizons each slice is a single part.
      const std::uint64_t links_in_all = mesh == MeshMode::k2d ? 0
                                         : mesh == MeshMode::kRing
                                             ? nodes * (nodes - 1) / 2
                                             : nodes / 2 * Hypercube::of_size(nodes)->dimension();
      const auto stats = nlohmann::json::parse(outcome.done->stats.text);
      const auto& distribution = stats["distribution"];
      CHECK(distribution["slices"] == nodes);
      CHECK(distribution["link_batches"] == links_in_all);
      CHECK((distribution["link_bytes"] > 0) == (links_in_all > 0));
      CHECK(stats["choices"]["mesh"] == to_string(mesh));
      const bool adds_up = mesh != MeshMode::k2d;
      const char* sums = mesh == MeshMode::kRing ? "ring" : adds_up ? "tree" : "direct";
      CHECK(stats["choices"]["sums"] == sums);
      for (const control::NodeStats& n : outcome.reports) {
        if (adds_up && n.rank != 0) CHECK(n.contribution_batches == 0);
      }
    }
  }
}

TEST_CASE("jobs follow each other in different meshes on one farm") {
  const std::string text = tiny_scene(16, 16);
  RandomFarm farm({.nodes = 8});
  std::uint32_t job = 0;
  for (const MeshMode mesh : {MeshMode::kRing, MeshMode::k3d, MeshMode::kTree, MeshMode::k2d,
                              MeshMode::k3d, MeshMode::kRing}) {
    control::JobOptions options = with(Algorithm::kMacro);
    options.mesh = mesh;
    check_same_picture(farm, farm.render(text, options), ++job, serial_picture(text));
  }
}

TEST_CASE("a ring whose columns would be too many for a grid is refused with the reason") {
  control::JobOptions options = with(Algorithm::kMacro);
  options.mesh = MeshMode::kRing;
  options.scatter = 8;
  PreparationWork work;
  const std::string text = tiny_scene(16, 16);
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  work.scene = Bytes(bytes.begin(), bytes.end());
  work.options = options;
  work.cube = *Hypercube::of_size(1024);
  const PreparationResult result = prepare(work, [] { return 0.0; });
  REQUIRE_FALSE(result.scene);
  REQUIRE(result.errors.size() == 1);
  CHECK(result.errors.front().where == "--scatter");
  CHECK(result.errors.front().why == "expected 1 to 4, found 8");
  CHECK_FALSE(result.is_internal);
}
