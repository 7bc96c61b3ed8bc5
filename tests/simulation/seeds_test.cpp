// Thousands of tiny renders, each on a farm, in a way and with delays that its seed decides: never
// a deadlock, never an early end, the bounds on rays kept, and always the serial picture.
// GRAYCUBE_SEEDS=N runs N of them, GRAYCUBE_SEED=S only that one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <random>

#include "proto/batch.hpp"
#include "simulation/pictures.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr std::uint64_t kSeeds = 2000;
constexpr std::uint32_t kDepth = 3, kLights = 2;

/// A mirror that faces another, glass between them, and two lights, one of them there too.
std::string tiny_scene(unsigned width, unsigned height) {
  return R"({"graycube": 1, "image": {"width": )" + std::to_string(width) + R"(, "height": )" +
         std::to_string(height) + R"(},
  "camera": {"type": "perspective", "eye": [0,1,-6], "look_at": [0,0,0], "up": [0,1,0], "fov": 60},
  "background": [0.1,0.2,0.4], "max_depth": )" +
         std::to_string(kDepth) + R"(,
  "lights": [{"type": "point", "position": [5,9,-6], "color": [0.6,0.6,0.6]},
             {"type": "point", "position": [-1,0.5,-1], "color": [0.4,0.3,0.3]}],
  "materials": {"mirror": {"color": [0.9,0.8,0.9], "diffuse": 0.2, "reflect": 0.8},
                "glass": {"diffuse": 0.1, "transmit": 0.9, "reflect": 0.1, "ior": 1.5}},
  "objects": [
    {"material": "mirror", "csg": {"type": "box", "min": [-3,-2,1], "max": [3,2,1.5]}},
    {"material": "mirror", "csg": {"type": "box", "min": [-3,-1.5,-3], "max": [-2.6,2,1]}},
    {"material": "glass", "csg": {"type": "difference", "children": [
       {"type": "sphere", "center": [0.3,0,-1], "radius": 1.1},
       {"type": "cylinder", "base": [0,0,-3], "top": [0,0,3], "radius": 0.4}]}}]})";
}

struct Pictures {
  std::string text;
  Picture expected;
  std::uint32_t pixels;
  Pictures(unsigned width, unsigned height)
      : text(tiny_scene(width, height)), expected(serial_picture(text)), pixels(width * height) {}
};

/// One seed's farm and job.
struct Trial {
  RandomFarmOptions farm;
  control::JobOptions job;
  bool is_square = false;  ///< larger: small pictures can't be cut by load

  std::string name() const {
    const std::string sums = " " + std::string(to_string(job.sums));
    if (job.algorithm == Algorithm::kRoth)
      return "roth " + std::string(to_string(job.grain)) + sums;
    return "macro " + std::string(to_string(job.shadows)) + " " +
           std::string(to_string(job.partition)) + " " + std::string(to_string(job.flow)) + sums;
  }
};

Trial trial_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  Trial t;
  t.farm.seed = seed;
  t.farm.nodes = 1u << below(5);
  t.farm.threads = 1 + below(3);
  t.farm.link_delay_s = below(2) == 0 ? 1e-3 : 1e-1;
  // A window of one ray on a link that takes ten seconds: slow, but no deadlock.
  t.farm.heartbeat_s = t.farm.link_delay_s > 1e-2 ? 100 : 1;
  t.farm.stalled_s = 1e6 * t.farm.link_delay_s;
  t.farm.limits.batch_bytes = static_cast<std::uint32_t>(kRayBytes) << below(4);
  t.farm.limits.link_credit_bytes = t.farm.limits.batch_bytes << (below(2) * below(3));
  t.farm.limits.window_tiles = 1 + below(2);
  t.job.algorithm = below(8) == 0 ? Algorithm::kRoth : Algorithm::kMacro;
  t.job.grain = static_cast<Grain>(below(3));
  t.job.shadows = static_cast<ShadowMode>(below(3));
  t.job.scatter = 1 + below(3);
  if (below(4) == 0) {
    t.job.partition = PartitionMode::kBalanced;
    t.job.scatter = 1;
    t.farm.nodes = std::min(t.farm.nodes, 4u);
    t.is_square = true;
  }
  if (below(6) == 0) {
    t.job.flow = FlowMode::kBlocking;
    t.job.queue = 1 + below(40);
    t.farm.link_delay_s = 1e-3;  // a ray a message: on slower links a picture takes hours
    t.farm.heartbeat_s = 1;
  }
  if (below(2) == 0) t.farm.replica_bytes = 0;
  if (below(2) == 0) t.job.sums = SumsMode::kTree;
  if (below(2) == 0) t.farm.limits.outbox_rays = 1 + below(40);
  return t;
}

/// Rays that descend from one primary ray at most, it included: each but shadow rays sends two
/// others and one to each light.
constexpr std::uint64_t largest_tree() {
  return ((std::uint64_t{2} << kDepth) - 1) * (1 + kLights);
}

/// What a node may hold: in its inbox what its links' credit and its classes allow, in its outboxes
/// what descends from the tiles that are open anywhere, and what it may hold before it is full,
/// with what its evaluators add to that.
void check_bounds(const Trial& t, const Outcome& outcome, std::uint64_t pixels) {
  if (t.job.algorithm != Algorithm::kMacro) return;
  const std::uint64_t links = Hypercube::of_size(t.farm.nodes)->dimension();
  const Hypercube cube = *Hypercube::of_size(t.farm.nodes);
  const std::uint64_t classes =
      t.job.flow == FlowMode::kBlocking
          ? 0
          : most_hops(kDepth, t.job.scatter * cube.columns(), t.job.scatter * cube.rows());
  constexpr std::uint64_t kChildren = kLights + 2;
  const std::uint64_t own = classes * t.farm.threads * kChildren * (kDepth + 1);
  std::uint64_t inbox = links * (t.farm.limits.link_credit_bytes / kRayBytes + classes) + own;
  if (t.job.flow == FlowMode::kBlocking)
    inbox = links == 0 ? 0 : std::max<std::uint64_t>(t.job.queue, links);
  REQUIRE(outcome.reports.size() == t.farm.nodes);
  for (const control::NodeStats& n : outcome.reports) {
    // Rays that waited for a borrowed model lie there too.
    if (t.job.shadows != ShadowMode::kLocal) CHECK(n.queue_peak <= inbox);
    CHECK(n.outbox_peak <= pixels * largest_tree());
    const std::uint64_t most = t.farm.limits.outbox_rays;
    const std::uint64_t added = std::max<std::uint64_t>(1, most / kWorksPerOutboxes) +
                                (Evaluator::kWaveRays + classes) * kChildren;
    CHECK(n.outbox_peak <= most + t.farm.threads * added);
  }
}

std::uint64_t number_in_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace

TEST_CASE(
    "thousands of seeds: the serial picture, never a deadlock, never an early end, bounds kept") {
  const Pictures small(12, 8), square(16, 16);
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::map<std::string, unsigned> ways;
  std::uint64_t deadlocks = 0, beyond_credit = 0, on_class = 0, rounds = 0;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    const Trial t = trial_of(seed);
    INFO("seed " << seed << ": " << t.name() << ", " << t.farm.nodes << " nodes, scatter "
                 << t.job.scatter);
    const Pictures& pictures = t.is_square ? square : small;
    RandomFarm farm(t.farm);
    const Outcome outcome = farm.render(pictures.text, t.job);
    ++ways[t.name()];
    on_class += outcome.class_rays;
    for (const control::NodeStats& n : outcome.reports) {
      beyond_credit += n.outbox_peak * kRayBytes > t.farm.limits.link_credit_bytes;
    }
    if (t.job.flow == FlowMode::kBlocking && outcome.failed) {
      ++deadlocks;
      CHECK(outcome.violations.empty());
      CHECK(outcome.failed->errors.front().why.starts_with("deadlock: node "));
      CHECK(outcome.failed->stats);
    } else {
      check_same_picture(farm, outcome, 1, pictures.expected);
    }
    check_bounds(t, outcome, pictures.pixels);
    // Two, two more once all tiles are whole, and now and then one for a ping.
    if (t.job.flow == FlowMode::kCredit)
      CHECK(outcome.rounds <= 5 + outcome.render_s / t.farm.heartbeat_s);
    rounds += outcome.rounds;
  }
  if (only != 0 || last < kSeeds) return;
  // Grains, and shadows × partition × flow, each with either sums: the seeds reach them all, and
  // where credit runs out and queues fill.
  CHECK(ways.size() == 2 * (3 + 3 * 2 * 2));
  CHECK(deadlocks > 5);
  CHECK(on_class > 10 * last);
  CHECK(rounds < 5 * last);
  CHECK(beyond_credit > last / 4);
}
