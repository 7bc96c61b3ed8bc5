// Every way in which macro can work, on simulated farms, by seed: each gives the serial picture.
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>

#include "catch.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/pictures.hpp"
#include "topology/hypercube.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

control::JobOptions macro_with(ShadowMode shadows, std::uint32_t scatter) {
  control::JobOptions o = with(Algorithm::kMacro);
  o.shadows = shadows;
  o.scatter = scatter;
  return o;
}

RandomFarmOptions farm_of(std::uint32_t nodes, std::uint64_t seed) {
  RandomFarmOptions options;
  options.nodes = nodes;
  options.threads = static_cast<std::uint32_t>(1 + seed % 3);
  options.seed = seed;
  options.link_delay_s = seed % 2 == 0 ? 1e-3 : 1e-1;
  return options;
}

/// The ranks in "deadlock: node 3 waits for node 1 waits for node 3, …".
std::vector<Rank> cycle_in(const std::string& message) {
  std::vector<Rank> cycle;
  const std::regex node("node ([0-9]+)");
  for (std::sregex_iterator at(message.begin(), message.end(), node), end; at != end; ++at) {
    cycle.push_back(Rank{static_cast<std::uint32_t>(std::stoul((*at)[1]))});
  }
  return cycle;
}

nlohmann::json stats_of_failure(const Outcome& outcome) {
  REQUIRE(outcome.failed->stats);
  return nlohmann::json::parse(outcome.failed->stats->text);
}

/// A machine on which the frontal hears rank 1 late, from some moment on.
class LateNode : public RandomMachine {
 public:
  explicit LateNode(std::uint64_t seed) : RandomMachine({.seed = seed}) {}
  double arrival_s(Place from, Place to, std::size_t bytes, double now_s) override {
    if (!from && to == Rank{0}) told_s.push_back(now_s);
    const bool is_late = from == Rank{1} && !to && now_s >= late_from_s;
    return RandomMachine::arrival_s(from, to, bytes, now_s) +
           (is_late ? 10 * kReportPatience_s : 0);
  }

  double late_from_s = std::numeric_limits<double>::infinity();
  /// The moments at which the frontal sent something to rank 0.
  std::vector<double> told_s;
};

}  // namespace

TEST_CASE("a deadlock is told, with the other nodes' reports, when one node's doesn't come") {
  const std::string text = scene_text(36, 24);
  control::JobOptions options = macro_with(ShadowMode::kForward, 1);
  options.flow = FlowMode::kBlocking;
  options.queue = 1;
  int deadlocks = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    INFO("seed " << seed);
    LateNode first(seed), again(seed);
    const Outcome heard = Farm({.nodes = 4}, first).render(text, options);
    if (!heard.failed) continue;
    ++deadlocks;
    // The last message of a node is `finish`: once for its report, and once when the job has ended.
    REQUIRE(first.told_s.size() > 2);
    again.late_from_s = first.told_s[first.told_s.size() - 2];
    const Outcome outcome = Farm({.nodes = 4}, again).render(text, options);
    REQUIRE(outcome.failed);
    CHECK(outcome.failed->errors == heard.failed->errors);
    CHECK(outcome.failed->code == FailureCode::kDeadlock);
    const nlohmann::json stats = stats_of_failure(outcome);
    REQUIRE(stats["per_node"].size() == 4);
    for (std::uint32_t rank = 0; rank < 4; ++rank) {
      CHECK(stats["per_node"][rank]["rank"] == rank);
      CHECK((stats["per_node"][rank]["pid"] == 0) == (rank == 1));
    }
  }
  CHECK(deadlocks > 2);
}

TEST_CASE("scattered regions, horizons and borrowed models give the serial picture") {
  const std::string text = scene_text(36, 24);
  const Picture expected = serial_picture(text);
  for (std::uint64_t seed = 1; seed <= 180; ++seed) {
    const std::uint32_t nodes = 1u << (seed % 6);
    const auto shadows = static_cast<ShadowMode>(seed % 3);
    const auto scatter = static_cast<std::uint32_t>(seed / 3 % 5);
    INFO("seed " << seed << ", " << nodes << " nodes, " << to_string(shadows) << ", scatter "
                 << scatter);
    control::JobOptions options = macro_with(shadows, scatter);
    if (seed % 5 == 0) options.partition = PartitionMode::kBalanced;
    RandomFarmOptions how = farm_of(nodes, seed);
    if (seed % 2 == 0) how.replica_bytes = 0;  // then models are borrowed
    RandomFarm farm(how);
    check_same_picture(farm, farm.render(text, options), 1, expected);
  }
}

TEST_CASE("with local shadows no shadow ray is forwarded, with horizons few are") {
  const std::string text = scene_text(36, 24);
  const auto forwarded = [&](ShadowMode shadows) {
    RandomFarm farm(farm_of(8, 2));
    const Outcome outcome = farm.render(text, macro_with(shadows, 1));
    REQUIRE(outcome.done);
    std::smatch found;
    const std::string stats = outcome.done->stats.text;
    REQUIRE(std::regex_search(stats, found, std::regex(R"("forwarded":\{"shadow":([0-9]+))")));
    return std::stoul(found[1]);
  };
  const auto all = forwarded(ShadowMode::kForward);
  CHECK(all > 100);
  CHECK(forwarded(ShadowMode::kHorizon) < all / 2);
  CHECK(forwarded(ShadowMode::kLocal) == 0);
}

TEST_CASE(
    "blocking queues give the serial picture or a deadlock, which is reported with its cycle") {
  const std::string text = scene_text(36, 24);
  const Picture expected = serial_picture(text);
  int deadlocks = 0, pictures = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::uint32_t nodes = 1u << (seed % 5);
    control::JobOptions options = macro_with(static_cast<ShadowMode>(seed % 3), 1 + seed % 2);
    options.flow = FlowMode::kBlocking;
    options.queue = seed % 4 == 0 ? 4096 : static_cast<std::uint32_t>(1 + seed % 7);
    INFO("seed " << seed << ", " << nodes << " nodes, queue " << options.queue);
    RandomFarmOptions how = farm_of(nodes, seed);
    how.link_delay_s = 1e-3;  // a ray a message: on slower links a picture takes hours
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    if (!outcome.failed) {
      ++pictures;
      check_same_picture(farm, outcome, 1, expected);
      continue;
    }
    ++deadlocks;
    REQUIRE(outcome.violations.empty());
    CHECK(outcome.failed->code == FailureCode::kDeadlock);
    REQUIRE(outcome.failed->errors.size() == 1);
    const std::string why = outcome.failed->errors.front().why;
    INFO(why);
    REQUIRE(why.starts_with("deadlock: node "));
    const std::vector<Rank> cycle = cycle_in(why.substr(0, why.find(',')));
    REQUIRE(cycle.size() >= 3);
    CHECK(cycle.front() == cycle.back());
    const Hypercube cube = *Hypercube::of_size(nodes);
    for (std::size_t i = 1; i < cycle.size(); ++i) CHECK(cube.link_between(cycle[i - 1], cycle[i]));
    // Each node has reported how far it got.
    const nlohmann::json stats = stats_of_failure(outcome);
    CHECK(stats["failed"] == why);
    CHECK(stats["balance"]["blocked_fraction"] > 0);
    CHECK(stats["rays"]["primary"] > 0);
    REQUIRE(stats["per_node"].size() == nodes);
    for (const Rank r : cycle) CHECK(stats["per_node"][r.value]["queue_peak"] > 0);
    // The farm is still good for another job.
    check_same_picture(farm, farm.render(text, with(Algorithm::kMacro)), 2, expected);
  }
  CHECK(deadlocks > 5);
  CHECK(pictures > 15);
}

TEST_CASE("with replicas nothing is forwarded, and neighbours trace the tiles of slow nodes") {
  const std::string text = scene_text(144, 96);
  const Picture expected = serial_picture(text);
  unsigned helped = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    RandomFarmOptions how = farm_of(1u << (1 + seed % 4), seed);
    how.limits.window_tiles = 1 + static_cast<std::uint32_t>(seed % 3);
    INFO("seed " << seed << ", " << how.nodes << " nodes");
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, macro_with(ShadowMode::kLocal, 1));
    check_same_picture(farm, outcome, 1, expected);
    CHECK(outcome.rounds <= 4);
    const std::uint64_t primitives = nlohmann::json::parse(outcome.done->stats.text)["primitives"];
    std::uint64_t primary = 0;
    for (const control::NodeStats& n : outcome.reports) {
      CHECK(n.forwarded_shadow + n.forwarded_secondary == 0);
      CHECK(n.primitives == primitives);
      primary += n.primary;
      helped += n.primary * how.nodes > 144 * 96;
    }
    CHECK(primary == 144 * 96);
  }
  CHECK(helped > 24);
}

TEST_CASE("a node with nothing left traces a neighbour's tiles in a copy of its regions") {
  const std::string text = scene_text(144, 96);
  const Picture expected = serial_picture(text, AovSet::all());
  std::uint64_t taken_over = 0;
  for (std::uint64_t seed = 1; seed <= 48; ++seed) {
    RandomFarmOptions how = farm_of(1u << (1 + seed % 4), seed);
    how.limits.window_tiles = 1 + static_cast<std::uint32_t>(seed % 3);
    how.stalled_s = 6000;  // a window of one tile on a slow link takes ten minutes
    control::JobOptions options =
        macro_with(seed % 2 == 0 ? ShadowMode::kHorizon : ShadowMode::kForward, 1 + seed % 2);
    options.aov = "depth,normal,albedo,object";
    if (seed % 5 == 0) options.sums = SumsMode::kTree;
    INFO("seed " << seed << ", " << how.nodes << " nodes");
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, expected);
    std::uint64_t primary = 0;
    for (const control::NodeStats& n : outcome.reports) {
      CHECK((n.tiles_taken_over + n.rays_taken_over == 0 || n.models_borrowed > 0));
      taken_over += n.tiles_taken_over + n.rays_taken_over;
      primary += n.primary;
    }
    CHECK(primary == 144 * 96);
  }
  CHECK(taken_over > 48);
}

TEST_CASE(
    "sums along the tree give the serial picture, AOVs too, and only the root sends to the "
    "frontal") {
  const std::string text = scene_text(48, 32);
  const Picture expected = serial_picture(text, AovSet::all());
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const std::uint32_t nodes = 1u << (seed % 7);
    control::JobOptions options = macro_with(static_cast<ShadowMode>(seed % 3), 1 + seed % 2);
    if (seed % 11 == 0) options = with(Algorithm::kRoth);
    options.sums = SumsMode::kTree;
    options.aov = "depth,normal,albedo,object";
    INFO("seed " << seed << ", " << nodes << " nodes, " << to_string(options.algorithm) << ", "
                 << to_string(options.shadows));
    RandomFarmOptions how = farm_of(nodes, seed);
    if (seed % 2 == 0) how.replica_bytes = 0;
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, expected);
    std::uint64_t primary = 0;
    for (const control::NodeStats& n : outcome.reports) {
      CHECK((n.contribution_batches > 0) == (n.rank == 0));
      CHECK((n.sum_batches > 0) == (n.rank != 0 && n.sum_bytes > 0));
      primary += n.primary;
    }
    CHECK(primary == 48 * 32);
    CHECK(nlohmann::json::parse(outcome.done->stats.text)["choices"]["sums"] == "tree");
  }
}

TEST_CASE("sums along the tree need at most four rounds of the token on 16 and 64 equal nodes") {
  const std::string text = scene_text(96, 64);
  const Picture expected = serial_picture(text);
  for (const std::uint32_t nodes : {16u, 64u}) {
    MachineFigures figures;
    figures.costs[Unit::kPiece] = 5e-6;
    figures.costs[Unit::kRay] = 2e-6;
    figures.costs[Unit::kMessage] = 2e-5;
    figures.link_us = 50;
    ModelledMachine machine(figures);
    Farm farm({.nodes = nodes}, machine);
    control::JobOptions options = macro_with(ShadowMode::kHorizon, 1);
    options.sums = SumsMode::kTree;
    INFO(nodes << " nodes");
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, expected);
    CHECK(outcome.rounds <= 4);
  }
}
