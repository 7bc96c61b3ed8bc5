// The rays that a node holds are bounded by the windows of open tiles, however deep the rays' trees
// are and however slow the links.
#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

#include "catch.hpp"
#include "proto/batch.hpp"
#include "simulation/pictures.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr std::uint32_t kSide = 16, kNodes = 8, kScatter = 4, kThreads = 2, kLights = 8;
/// Rays that a link's credit is for; a batch has a quarter of it.
constexpr std::uint32_t kCredit = 64;

/// Between two mirrors a wall of glass balls, and eight lights.
std::string hall_of_mirrors() {
  std::string lights;
  for (std::uint32_t i = 0; i < kLights; ++i) {
    lights += std::string(i == 0 ? "" : ",") +
              R"({"type": "point", "color": [0.2,0.2,0.2], "position": [)" +
              std::to_string(i % 4 - 1.5) + "," + std::to_string(i < 4 ? 1.8 : -1.2) + ",-1.5]}";
  }
  std::string balls;
  for (int i = 0; i < 9; ++i) {
    balls += R"(,{"material": "glass", "csg": {"type": "sphere", "radius": 0.5, "center": [)" +
             std::to_string(1.2 * (i % 3 - 1)) + "," + std::to_string(1.2 * (i / 3 - 1)) +
             R"(,-1]}})";
  }
  return R"({"graycube": 1, "image": {"width": )" + std::to_string(kSide) + R"(, "height": )" +
         std::to_string(kSide) + R"(},
  "camera": {"type": "perspective", "eye": [0,0.3,-4], "look_at": [0,0,0], "up": [0,1,0], "fov": 70},
  "background": [0.1,0.2,0.4], "max_depth": 12, "lights": [)" +
         lights + R"(],
  "materials": {"mirror": {"color": [0.9,0.8,0.9], "diffuse": 0.2, "reflect": 0.8},
                "glass": {"diffuse": 0.1, "transmit": 0.8, "reflect": 0.2, "ior": 1.5}},
  "objects": [
    {"material": "mirror", "csg": {"type": "box", "min": [-4,-3,1], "max": [4,3,1.5]}},
    {"material": "mirror", "csg": {"type": "box", "min": [-4,-3,-5.5], "max": [4,3,-5]}})" +
         balls + "]}";
}

/// Rays that descend from each tile's primary rays, these included; the largest number first. A
/// tile is a macro-region's part of the picture, which is smaller than tiles could be.
std::vector<std::uint64_t> trees_of(const std::string& text) {
  ReadResult read = read_scene_text(text);
  REQUIRE(read.scene);
  const Domain domain(compile_scene(*read.scene));
  Evaluator evaluator(domain);
  const Hypercube cube = *Hypercube::of_size(kNodes);
  const std::uint32_t width = kSide / (kScatter * cube.columns()),
                      height = kSide / (kScatter * cube.rows());
  REQUIRE(std::max(width, height) <= kTileSide);
  std::vector<std::uint64_t> trees;
  for (std::uint32_t y = 0; y < kSide; y += height) {
    for (std::uint32_t x = 0; x < kSide; x += width) {
      Step step;
      evaluator.trace_pixels({x, y, x + width, y + height}, step);
      const auto& created = step.rays.created;
      trees.push_back(std::accumulate(created.begin(), created.end(), std::uint64_t{0}));
    }
  }
  std::sort(trees.begin(), trees.end(), std::greater<>());
  return trees;
}

Outcome render(const std::string& text, const Picture& expected, std::uint64_t seed,
               std::uint32_t window, std::uint64_t outbox_rays = FlowLimits{}.outbox_rays) {
  RandomFarmOptions options{.nodes = kNodes, .threads = kThreads, .seed = seed, .link_delay_s = 1};
  options.heartbeat_s = 1e4;
  options.stalled_s = 1e7;
  options.limits = {.window_tiles = window,
                    .link_credit_bytes = kCredit * kRayBytes,
                    .batch_bytes = kCredit / 4 * kRayBytes,
                    .outbox_rays = outbox_rays};
  control::JobOptions job = with(Algorithm::kMacro);
  job.shadows = ShadowMode::kForward;
  job.scatter = kScatter;
  RandomFarm farm(options);
  Outcome outcome = farm.render(text, job);
  check_same_picture(farm, outcome, 1, expected);
  REQUIRE(outcome.reports.size() == kNodes);
  return outcome;
}

std::uint64_t largest_outbox(const Outcome& outcome) {
  std::uint64_t most = 0;
  for (const control::NodeStats& n : outcome.reports) most = std::max(most, n.outbox_peak);
  return most;
}

}  // namespace

TEST_CASE(
    "between mirrors and glass at depth 12 with eight lights, windows bound what nodes hold") {
  const std::string text = hall_of_mirrors();
  const Picture expected = serial_picture(text);
  const std::vector<std::uint64_t> trees = trees_of(text);
  const auto bound = std::accumulate(trees.begin(), trees.begin() + kNodes, std::uint64_t{0});
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Outcome narrow = render(text, expected, seed, 1);
    const Outcome wide = render(text, expected, seed, 64);
    INFO("seed " << seed << ", bound " << bound << ", peaks " << largest_outbox(narrow) << " and "
                 << largest_outbox(wide));
    for (const control::NodeStats& n : narrow.reports) {
      CHECK(n.outbox_peak <= bound);
      CHECK(n.queue_peak <= Hypercube::of_size(kNodes)->dimension() * kCredit);
    }
    // Many times as much waits if the whole picture is open: so the window is the bound.
    CHECK(largest_outbox(wide) > 4 * largest_outbox(narrow));
  }
}

TEST_CASE("between mirrors and glass, nodes that are full hold no more, whatever the windows") {
  const std::string text = hall_of_mirrors();
  const Picture expected = serial_picture(text);
  constexpr std::uint64_t kMost = 64;
  // An evaluator adds a part of the bound, and then a packet's rays, or those for which its class
  // keeps room.
  constexpr std::uint64_t kBound =
      kMost + kThreads * (kMost / kWorksPerOutboxes + (Evaluator::kWaveRays + 1) * (kLights + 2));
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Outcome free = render(text, expected, seed, 64);
    const Outcome full = render(text, expected, seed, 64, kMost);
    INFO("seed " << seed << ", bound " << kBound << ", peaks " << largest_outbox(full) << " and "
                 << largest_outbox(free) << ", " << full.class_rays << " rays on class credit");
    CHECK(largest_outbox(full) <= kBound);
    CHECK(largest_outbox(free) > 2 * kBound);
    CHECK(free.class_rays == 0);
    CHECK(full.class_rays > 0);
  }
}
