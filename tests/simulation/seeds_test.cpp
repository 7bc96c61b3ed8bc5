// Thousands of tiny renders, each on a farm, in a way and with delays that its seed decides. There
// is never a deadlock or an early end, rays keep their bounds, and the picture is the serial one.
// GRAYCUBE_SEEDS=N runs N of them, GRAYCUBE_SEED=S only that one.
#include <algorithm>
#include <map>

#include "catch.hpp"
#include "proto/batch.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr std::uint64_t kSeeds = 2000;
struct Pictures {
  std::string text;
  Picture expected;
  std::uint32_t pixels;
  Pictures(unsigned width, unsigned height)
      : text(tiny_scene(width, height)), expected(serial_picture(text)), pixels(width * height) {}
};

/// The most rays that descend from one primary ray, itself included: each but a shadow ray sends
/// out two others, and one to each light.
constexpr std::uint64_t largest_tree() {
  return ((std::uint64_t{2} << kDepth) - 1) * (1 + kLights);
}

/// Checks the rays that a node held: in its inbox at most what credit and classes of its links
/// allow; in its outboxes at most what descends from all open tiles, and what they may hold before
/// it is full, with what its evaluators add.
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
    // Rays that waited for a borrowed model are counted there, too.
    if (t.job.shadows != ShadowMode::kLocal) CHECK(n.queue_peak <= inbox);
    CHECK(n.outbox_peak <= pixels * largest_tree());
    const std::uint64_t most = t.farm.limits.outbox_rays;
    const std::uint64_t added = std::max<std::uint64_t>(1, most / kWorksPerOutboxes) +
                                (Evaluator::kWaveRays + classes) * kChildren;
    CHECK(n.outbox_peak <= most + t.farm.threads * added);
  }
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
    // There are two rounds, two more once all tiles are whole, and now and then one for a ping.
    if (t.job.flow == FlowMode::kCredit)
      CHECK(outcome.rounds <= 5 + outcome.render_s / t.farm.heartbeat_s);
    rounds += outcome.rounds;
  }
  if (only != 0 || last < kSeeds) return;
  // The ways are grains, and shadows × partition × flow, each with either sums. The seeds reach
  // them all, and cases in which credit runs out and queues fill.
  CHECK(ways.size() == 2 * (3 + 3 * 2 * 2));
  CHECK(deadlocks > 5);
  CHECK(on_class > 10 * last);
  CHECK(rounds < 5 * last);
  CHECK(beyond_credit > last / 4);
}
