// Boundaries that slide while a picture is rendered, on simulated farms, by seed: the picture is
// the serial one wherever they slide, there is always an end, and a node holds no more than two
// generations of the grid.
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

/// Boundaries that slide whenever they may, for any difference.
constexpr SlidingLimits kRestless{.rules = {.least_ratio = 1.001, .most_part = 0.5},
                                  .part_between = 0,
                                  .least_ahead = 1,
                                  .most_ahead = 0};

control::JobOptions sliding(PartitionMode partition = PartitionMode::kRegular) {
  control::JobOptions options = with(Algorithm::kMacro);
  options.boundaries = BoundariesMode::kSliding;
  options.partition = partition;
  return options;
}

nlohmann::json statistics_of(const Outcome& outcome) {
  REQUIRE(outcome.done);
  return nlohmann::json::parse(outcome.done->stats.text);
}

/// A scene whose work lies in a corner: a heap of mirrors, and nothing elsewhere.
std::string corner_heap(unsigned side) {
  std::string balls;
  for (int i = 0; i < 64; ++i) {
    balls += std::string(i == 0 ? "" : ",") +
             R"({"material": "mirror", "csg": {"type": "sphere", "radius": 0.24, "center": [)" +
             std::to_string(-2.6 + 0.4 * (i % 4)) + "," + std::to_string(2.6 - 0.4 * (i / 4 % 4)) +
             "," + std::to_string(0.5 * (i / 16)) + "]}}";
  }
  const std::string s = std::to_string(side);
  return R"({"graycube": 1, "image": {"width": )" + s + R"(, "height": )" + s + R"(},
  "camera": {"type": "orthographic", "eye": [0,0,-9], "look_at": [0,0,0], "up": [0,1,0],
             "width": 6.4},
  "background": [0.1,0.2,0.4], "max_depth": 6,
  "lights": [{"type": "point", "position": [-5,9,-6], "color": [0.6,0.6,0.6]}],
  "materials": {"mirror": {"color": [0.9,0.9,0.9], "diffuse": 0.2, "reflect": 0.8}},
  "objects": [)" +
         balls + "]}";
}

/// The busiest node's part of all the work.
double busiest_share(const Outcome& outcome) {
  double most = 0, sum = 0;
  for (const control::NodeStats& n : outcome.reports) {
    most = std::max(most, n.busy_s);
    sum += n.busy_s;
  }
  return most / sum;
}

}  // namespace

TEST_CASE("boundaries that slide at every chance leave the serial picture, whatever the delays") {
  constexpr std::uint64_t kSeeds = 400;
  const std::string text = tiny_scene(48, 40);
  const Picture expected = serial_picture(text);
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::uint64_t slides = 0, slices = 0, with_slides = 0, deadlocks = 0, on_class = 0;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    Trial t = trial_of(seed);
    t.farm.nodes = std::max(2u, t.farm.nodes);
    t.farm.limits.sliding = kRestless;
    t.farm.limits.window_tiles = 4 + static_cast<std::uint32_t>(seed % 60);
    t.job.algorithm = Algorithm::kMacro;
    t.job.boundaries = BoundariesMode::kSliding;
    t.job.scatter = 1;
    if (t.job.shadows == ShadowMode::kLocal) t.job.shadows = ShadowMode::kForward;
    if (seed % 3 == 0) t.job.returns = ReturnsMode::kSender;
    INFO("seed " << seed << ": " << t.name() << ", " << t.farm.nodes << " nodes");
    RandomFarm farm(t.farm);
    const Outcome outcome = farm.render(text, t.job);
    if (t.job.flow == FlowMode::kBlocking && outcome.failed) {
      ++deadlocks;
      CHECK(outcome.failed->code == FailureCode::kDeadlock);
      continue;
    }
    check_same_picture(farm, outcome, 1, expected);
    on_class += outcome.class_rays;
    const auto stats = statistics_of(outcome);
    REQUIRE(stats["choices"]["boundaries"] == "sliding");
    const auto& figures = stats["sliding"];
    CHECK(figures["generations_peak"] <= kMostGenerations);
    CHECK(figures["boundaries"] >= figures["slides"]);
    slides += figures["slides"].get<std::uint64_t>();
    slices += figures["slices"].get<std::uint64_t>();
    with_slides += figures["slides"] > 0;
  }
  if (only != 0 || last < kSeeds) return;
  CHECK(slides > 2 * last);
  CHECK(slices > last);
  CHECK(with_slides > last / 2);
  CHECK(on_class > last);
}

TEST_CASE("samples, AOVs, sums by tree and several threads go together with sliding boundaries") {
  std::uint64_t slides = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const std::string text = scene_text(96, 64);
    RandomFarmOptions how{.nodes = 1u << (1 + seed % 4),
                          .threads = static_cast<std::uint32_t>(1 + seed % 3),
                          .seed = seed};
    how.limits.sliding = kRestless;
    control::JobOptions options =
        sliding(seed % 2 == 0 ? PartitionMode::kBalanced : PartitionMode::kAuto);
    options.aov = "depth,normal,albedo,object";
    options.subdivision.way = seed % 4 == 3 ? Subdivision::kLinked : Subdivision::kSurfaces;
    if (seed % 5 == 0) options.sums = SumsMode::kTree;
    INFO("seed " << seed << ", " << how.nodes << " nodes");
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, serial_picture(text, AovSet::all()));
    slides += statistics_of(outcome)["sliding"]["slides"].get<std::uint64_t>();
  }
  CHECK(slides > 16);
}

TEST_CASE(
    "where the work lies in a corner, boundaries slide towards it and nodes share it better") {
  const std::string text = corner_heap(192);
  const Picture expected = serial_picture(text);
  MachineFigures figures;
  figures.costs[Unit::kPiece] = 3e-6;
  figures.costs[Unit::kRay] = 2e-7;
  figures.costs[Unit::kVisit] = 5e-7;
  figures.costs[Unit::kTest] = 5e-7;
  figures.costs[Unit::kNodeCall] = 1e-6;
  figures.costs[Unit::kBuildByte] = 1e-8;
  double share[2], seconds[2];
  for (const bool slides : {false, true}) {
    ModelledMachine machine(figures);
    Farm farm({.nodes = 4, .threads = 1}, machine);
    control::JobOptions options = sliding();
    if (!slides) options.boundaries = BoundariesMode::kFixed;
    options.shadows = ShadowMode::kForward;
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, expected);
    share[slides] = busiest_share(outcome);
    seconds[slides] = outcome.render_s;
    const auto stats = statistics_of(outcome);
    CHECK(stats.contains("sliding") == slides);
    if (!slides) continue;
    CHECK(stats["sliding"]["slides"] >= 3);
    CHECK(stats["sliding"]["slice_bytes"] > 0);
    CHECK(stats["sliding"]["new_primitives"] < stats["sliding"]["primitives"]);
    CHECK(stats["sliding"]["generations_peak"] == 2);
  }
  INFO("busiest node's share " << share[0] << " and " << share[1] << ", seconds " << seconds[0]
                               << " and " << seconds[1]);
  CHECK(share[0] > 0.6);
  CHECK(share[1] < 0.8 * share[0]);
  CHECK(seconds[1] < 0.95 * seconds[0]);
}

TEST_CASE("a picture too small to slide, and one node, are told to have fixed boundaries") {
  for (const std::uint32_t nodes : {1u, 8u}) {
    RandomFarm farm({.nodes = nodes});
    const std::string text = tiny_scene(8, 4);
    const Outcome outcome = farm.render(text, sliding());
    check_same_picture(farm, outcome, 1, serial_picture(text));
    const auto stats = statistics_of(outcome);
    CHECK(stats["choices"]["boundaries"] == "fixed");
    CHECK_FALSE(stats.contains("sliding"));
  }
}

TEST_CASE("what can't slide is refused in words") {
  for (const bool is_local : {true, false}) {
    control::JobOptions options = sliding();
    if (is_local) options.shadows = ShadowMode::kLocal;
    if (!is_local) options.scatter = 2;
    RandomFarm farm({.nodes = 4});
    const Outcome outcome = farm.render(tiny_scene(48, 40), options);
    REQUIRE(outcome.failed);
    CHECK(outcome.failed->code == FailureCode::kBadInput);
    CHECK(outcome.failed->errors.front().where == "--boundaries");
  }
}
