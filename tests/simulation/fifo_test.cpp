// FIFOs of received rays that are processes apart, on simulated farms: the picture is the serial
// one, deadlocks are found as ever, and what the processes cost is told.
#include <nlohmann/json.hpp>
#include <vector>

#include "catch.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

control::JobOptions blocking(FifoMode fifo, std::uint32_t queue = kMaxQueue) {
  control::JobOptions options = with(Algorithm::kMacro);
  options.shadows = ShadowMode::kForward;
  options.flow = FlowMode::kBlocking;
  options.queue = queue;
  options.fifo = fifo;
  return options;
}

struct Totals {
  std::uint64_t rays_in = 0, fifo_messages = 0;
  double cpu_s = 0, fifo_cpu_s = 0, fifo_wait_s = 0;
};

Totals totals_of(const Outcome& outcome) {
  Totals t;
  for (const control::NodeStats& n : outcome.reports) {
    t.rays_in += n.rays_in;
    t.fifo_messages += n.fifo_messages;
    t.cpu_s += n.cpu_s;
    t.fifo_cpu_s += n.fifo_cpu_s;
    t.fifo_wait_s += n.fifo_wait_s;
  }
  return t;
}

/// A machine where a message takes 20 µs on either side, and little else takes any time.
MachineFigures costly_messages() {
  MachineFigures figures;
  for (double& cost : figures.costs.value) cost = 1e-7;
  figures.costs[Unit::kMessage] = 20e-6;
  figures.costs[Unit::kMessageByte] = 0;
  return figures;
}

}  // namespace

TEST_CASE("with FIFOs apart every way of working gives the serial picture, or a deadlock") {
  constexpr std::uint64_t kSeeds = 400;
  const std::string small = tiny_scene(12, 8), square = tiny_scene(16, 16);
  const Picture expected[] = {serial_picture(small), serial_picture(square)};
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::uint64_t deadlocks = 0, pictures = 0, fetched = 0;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    Trial t = trial_of(seed);
    t.job.algorithm = Algorithm::kMacro;
    t.job.flow = FlowMode::kBlocking;
    t.job.queue = seed % 3 == 0 ? static_cast<std::uint32_t>(1 + seed % 7) : 4096;
    t.job.fifo = FifoMode::kProcess;
    if (seed % 5 == 0) t.job.returns = ReturnsMode::kSender;
    t.farm.link_delay_s = 1e-3;
    t.farm.heartbeat_s = 1;
    INFO("seed " << seed << ": " << t.name() << ", " << t.farm.nodes << " nodes, queue "
                 << t.job.queue);
    RandomFarm farm(t.farm);
    const Outcome outcome = farm.render(t.is_square ? square : small, t.job);
    CHECK(outcome.violations.empty());
    const Totals totals = totals_of(outcome);
    fetched += totals.fifo_messages;
    const std::uint64_t links = Hypercube::of_size(t.farm.nodes)->dimension();
    for (const control::NodeStats& n : outcome.reports) {
      if (t.job.shadows != ShadowMode::kLocal && links > 0)
        CHECK(n.queue_peak <= std::max<std::uint64_t>(t.job.queue, links));
    }
    if (outcome.failed) {
      ++deadlocks;
      CHECK(outcome.failed->code == FailureCode::kDeadlock);
      CHECK(outcome.failed->errors.front().why.starts_with("deadlock: node "));
      continue;
    }
    ++pictures;
    check_same_picture(farm, outcome, 1, expected[t.is_square ? 1 : 0]);
    // Each ray is put in, asked for and handed out.
    CHECK(totals.fifo_messages == 3 * totals.rays_in);
  }
  if (only != 0 || last < kSeeds) return;
  CHECK(deadlocks > 20);
  CHECK(pictures > 200);
  CHECK(fetched > 10000);
}

TEST_CASE("queues that fill up deadlock with FIFOs apart as they do without") {
  constexpr std::uint32_t kQueue = 16;
  const std::string text = scene_text(36, 24);
  for (const FifoMode fifo : {FifoMode::kThread, FifoMode::kProcess}) {
    ModelledMachine machine(costly_messages());
    Farm farm({.nodes = 8, .threads = 1}, machine);
    const Outcome outcome = farm.render(text, blocking(fifo, kQueue));
    REQUIRE(outcome.failed);
    CHECK(outcome.failed->code == FailureCode::kDeadlock);
    CHECK(outcome.violations.empty());
    const Totals totals = totals_of(outcome);
    CHECK(totals.rays_in > 10 * kQueue);
    double blocked_s = 0;
    std::uint64_t waiting = 0;
    for (const control::NodeStats& n : outcome.reports) {
      blocked_s += n.blocked_s;
      waiting = std::max(waiting, n.queue_peak);
    }
    CHECK(blocked_s > 0);
    CHECK(waiting > kQueue / 2);
    CHECK(waiting <= kQueue);
    // Many rays were handed out before, and some never were.
    if (fifo == FifoMode::kProcess) {
      CHECK(totals.fifo_messages > 2 * totals.rays_in);
      CHECK(totals.fifo_messages < 3 * totals.rays_in);
    }
  }
}

TEST_CASE("a FIFO apart costs its node what its messages cost, which statistics tell") {
  const std::string text = scene_text(36, 24);
  const Picture expected = serial_picture(text);
  Totals totals[2];
  double render_s[2] = {};
  for (const FifoMode fifo : {FifoMode::kThread, FifoMode::kProcess}) {
    const auto way = static_cast<std::size_t>(fifo);
    ModelledMachine machine(costly_messages());
    Farm farm({.nodes = 8, .threads = 1}, machine);
    const Outcome outcome = farm.render(text, blocking(fifo));
    check_same_picture(farm, outcome, 1, expected);
    totals[way] = totals_of(outcome);
    render_s[way] = outcome.render_s;
    const auto stats = nlohmann::json::parse(outcome.done->stats.text);
    CHECK(stats["choices"].contains("fifo") == (fifo == FifoMode::kProcess));
    CHECK(stats["messages"].contains("fifo_messages") == (fifo == FifoMode::kProcess));
    CHECK(stats["per_node"][3].contains("fifo_wait_s") == (fifo == FifoMode::kProcess));
    if (fifo == FifoMode::kThread) continue;
    CHECK(stats["choices"]["fifo"] == "process");
    CHECK(stats["messages"]["fifo_messages"] == totals[way].fifo_messages);
    CHECK(stats["per_node"][3]["fifo_wait_s"] == outcome.reports[3].fifo_wait_s);
  }
  CHECK(totals[0].fifo_messages == 0);
  CHECK(totals[0].fifo_cpu_s == 0);
  CHECK(totals[0].fifo_wait_s == 0);
  const auto messages = static_cast<double>(totals[1].fifo_messages);
  REQUIRE(messages > 1000);
  CHECK(totals[1].fifo_cpu_s == Approx(messages * 20e-6));
  // The node takes as much again for its side of them.
  CHECK(totals[1].cpu_s - totals[0].cpu_s > 1.9 * messages * 20e-6);
  CHECK(totals[1].fifo_wait_s > 0);
  CHECK(render_s[1] > render_s[0]);
}

TEST_CASE("given costs, a run with FIFOs apart replays to the last message") {
  const std::string text = scene_text(36, 24);
  std::vector<double> moments[2];
  for (std::vector<double>& sent : moments) {
    ModelledMachine machine(costly_messages());
    Farm farm({.nodes = 4, .threads = 1}, machine);
    farm.on_sent = [&](Place, Place, double sent_s, const Message&) { sent.push_back(sent_s); };
    REQUIRE(farm.render(text, blocking(FifoMode::kProcess)).done);
  }
  CHECK((moments[0] == moments[1]) == true);
}

TEST_CASE("a farm renders one job with FIFOs apart after another, failed ones too") {
  const std::string text = scene_text(36, 24);
  const Picture expected = serial_picture(text);
  RandomFarm farm({.nodes = 4, .seed = 3});
  std::uint32_t job = 0;
  for (const std::uint32_t queue : {kMaxQueue, 1u, kMaxQueue, 2u, kMaxQueue}) {
    const Outcome outcome = farm.render(text, blocking(FifoMode::kProcess, queue));
    ++job;
    CHECK(outcome.violations.empty());
    if (queue == kMaxQueue) check_same_picture(farm, outcome, job, expected);
  }
}
