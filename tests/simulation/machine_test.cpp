// The parts of predictions: costs per unit, cores, links.
#include <random>

#include "catch.hpp"
#include "simulation/cost_fit.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/pictures.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

/// Pieces of work of random size, at these costs, measured with that much error.
CostFit fit_of(const PerUnit& costs, double error, double overhead_s = 0) {
  CostFit fit(overhead_s);
  std::mt19937_64 random(7);
  const auto below = [&](double most) {
    return std::floor(std::uniform_real_distribution<double>(0, most)(random));
  };
  for (int i = 0; i < 4000; ++i) {
    PerUnit counts;
    if (i % 2 == 0) {
      counts[Unit::kPiece] = 1;
      counts[Unit::kRay] = below(200);
      counts[Unit::kVisit] = below(1000);
    } else {
      counts[Unit::kNodeCall] = 1;
      counts[Unit::kRayIn] = below(300);
    }
    const double noise = 1 + error * (std::uniform_real_distribution<double>(-1, 1)(random));
    fit.add(counts, cost_of(counts, costs) * noise + overhead_s);
  }
  return fit;
}

PerUnit some_costs() {
  PerUnit costs;
  costs[Unit::kPiece] = 3e-6;
  costs[Unit::kRay] = 2e-7;
  costs[Unit::kVisit] = 5e-8;
  costs[Unit::kNodeCall] = 1e-6;
  costs[Unit::kRayIn] = 4e-8;
  return costs;
}

MachineFigures some_machine() {
  MachineFigures figures;
  figures.costs = some_costs();
  figures.costs[Unit::kMessage] = 1e-5;
  return figures;
}

Outcome predicted(const MachineFigures& figures, const std::string& text,
                  const control::JobOptions& options, Picture* picture = nullptr) {
  ModelledMachine machine(figures);
  Farm farm({.nodes = 8, .threads = 1}, machine);
  const Outcome outcome = farm.render(text, options);
  REQUIRE(outcome.done);
  CHECK(outcome.violations.empty());
  if (picture != nullptr) *picture = *farm.store().picture(1);
  return outcome;
}

double busy_s(const Outcome& o) {
  double sum = 0;
  for (const control::NodeStats& n : o.reports) sum += n.busy_s;
  return sum;
}

}  // namespace

TEST_CASE("costs are found from work made of many units, whatever measuring adds") {
  const PerUnit costs = some_costs();
  const PerUnit found = fit_of(costs, 0, 2e-6).costs();
  for (std::size_t i = 0; i < kUnits; ++i) {
    INFO("unit " << i);
    CHECK(found.value[i] == Approx(costs.value[i]).epsilon(1e-3));
  }
}

TEST_CASE("costs from noisy measurements are not negative and meet their sum") {
  PerUnit costs = some_costs();
  costs[Unit::kPiece] = 0;
  const CostFit fit = fit_of(costs, 0.5);
  const PerUnit found = fit.costs();
  for (const double cost : found.value) CHECK(cost >= 0);
  CHECK(cost_of(fit.counts(), found) == Approx(fit.seconds()));
}

TEST_CASE(
    "tasks wait for a core, those of the process that has it go first until its time slice ends") {
  Timeline timeline;
  Cores cores(timeline, 1);
  std::vector<std::pair<int, double>> ended;
  const auto ask = [&](std::uint32_t process, int name, double seconds) {
    cores.ask({process, [seconds] { return seconds; },
               [&ended, &timeline, name] { ended.emplace_back(name, timeline.now_s()); }});
  };
  ask(1, 10, 1e-3);
  ask(2, 20, 1e-3);
  ask(1, 11, 1e-3);
  ask(1, 12, 1e-3);
  ask(1, 13, 1e-3);
  while (timeline.run_one()) {
  }
  std::vector<int> order;
  for (const auto& e : ended) order.push_back(e.first);
  CHECK(order == std::vector{10, 11, 12, 20, 13});
  CHECK(ended.back().second == Approx(5e-3));
}

TEST_CASE("a mailroom's tasks go before the long ones of any process") {
  Timeline timeline;
  Cores cores(timeline, 1);
  Thread mailroom(cores);
  std::vector<int> order;
  const auto task = [&](std::uint32_t process, int name) {
    return Cores::Task{process, [] { return 1e-3; }, [&order, name] { order.push_back(name); }};
  };
  cores.ask(task(1, 1));
  cores.ask(task(1, 2));
  mailroom.ask(task(2, 3));
  mailroom.ask(task(2, 4));
  while (timeline.run_one()) {
  }
  CHECK(order == std::vector{1, 3, 4, 2});
}

TEST_CASE("two cores do twice as much, and a thread's tasks stay in order on them") {
  Timeline timeline;
  Cores cores(timeline, 2);
  Thread thread(cores);
  std::vector<int> order;
  const auto task = [&](int name, double seconds) {
    return Cores::Task{0, [seconds] { return seconds; }, [&order, name] { order.push_back(name); }};
  };
  thread.ask(task(1, 3e-3));
  thread.ask(task(2, 1e-3));
  cores.ask(task(3, 1e-3));
  cores.ask(task(4, 1e-3));
  while (timeline.run_one()) {
  }
  CHECK(order == std::vector{3, 4, 1, 2});
  CHECK(timeline.now_s() == Approx(4e-3));
}

TEST_CASE("a link carries one message after another, and all of the frontal's share one") {
  MachineFigures figures;
  figures.link_gbps = 8;  // a byte a nanosecond
  figures.host_gbps = 4;
  figures.link_us = 2;
  ModelledMachine machine(figures);
  const Rank a{0}, b{1}, c{2};
  CHECK(machine.arrival_s(a, b, 1000, 0) == Approx(3e-6));
  CHECK(machine.arrival_s(a, b, 1000, 0) == Approx(4e-6));
  CHECK(machine.arrival_s(b, a, 1000, 0) == Approx(3e-6));
  CHECK(machine.arrival_s(a, c, 1000, 0) == Approx(3e-6));
  CHECK(machine.arrival_s(a, {}, 1000, 0) == Approx(4e-6));
  CHECK(machine.arrival_s(b, {}, 1000, 0) == Approx(6e-6));
  CHECK(machine.arrival_s({}, b, 1000, 0) == Approx(4e-6));
  CHECK(machine.arrival_s(a, b, 1000, 1) == Approx(1 + 3e-6));
}

TEST_CASE("predictions replay exactly, and the picture is serial's") {
  const std::string text = scene_text(36, 24);
  Picture picture;
  const Outcome once = predicted(some_machine(), text, with(Algorithm::kMacro), &picture);
  const Outcome again = predicted(some_machine(), text, with(Algorithm::kMacro));
  CHECK(picture == serial_picture(text));
  CHECK(once.reports == again.reports);
  CHECK(once.render_s == again.render_s);
  CHECK(once.render_s > 0);
}

TEST_CASE("slower evaluators are busy for longer, and slow links make everybody wait") {
  const std::string text = scene_text(36, 24);
  const Outcome fast = predicted(some_machine(), text, with(Algorithm::kMacro));
  MachineFigures slow_cpu = some_machine(), slow_links = some_machine(), two_cores = some_machine();
  slow_cpu.cpu_scale = 100;
  slow_links.link_us = 1e5;
  two_cores.cores = 2;
  const Outcome slow = predicted(slow_cpu, text, with(Algorithm::kRoth));
  const Outcome roth = predicted(some_machine(), text, with(Algorithm::kRoth));
  CHECK(busy_s(slow) == Approx(100 * busy_s(roth)).epsilon(0.01));
  CHECK(predicted(slow_links, text, with(Algorithm::kMacro)).render_s > fast.render_s + 0.2);
  CHECK(predicted(two_cores, text, with(Algorithm::kMacro)).render_s > fast.render_s);
}

TEST_CASE("the nodes of a run that deadlocks report what they did until then") {
  MachineFigures figures = some_machine();
  figures.cpu_scale = 100;
  ModelledMachine machine(figures);
  Farm farm({.nodes = 8, .threads = 1}, machine);
  control::JobOptions options = with(Algorithm::kMacro);
  options.shadows = ShadowMode::kForward;
  options.flow = FlowMode::kBlocking;
  options.queue = 3;
  const Outcome outcome = farm.render(scene_text(36, 24), options);
  REQUIRE(outcome.failed);
  CHECK(outcome.failed->errors.front().why.starts_with("deadlock: node "));
  REQUIRE(outcome.reports.size() == 8);
  REQUIRE(outcome.render_s > 0);
  double blocked_s = 0;
  for (const control::NodeStats& n : outcome.reports) {
    CHECK(n.busy_s + n.blocked_s + n.window_s + n.idle_s <= outcome.render_s * 1.001);
    blocked_s += n.blocked_s;
  }
  CHECK(blocked_s > 0);
}
