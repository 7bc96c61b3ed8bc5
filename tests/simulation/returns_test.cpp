// Light that goes back along the rays' ways, on simulated farms, by seed: the picture is the serial
// one, and every ray that crossed a link is answered once.
#include <map>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

control::JobOptions back_to_senders() {
  control::JobOptions options = with(Algorithm::kMacro);
  options.returns = ReturnsMode::kSender;
  return options;
}

}  // namespace

TEST_CASE("light goes back along the rays' ways in every way of working, whatever the delays") {
  constexpr std::uint64_t kSeeds = 600;
  const std::string small = tiny_scene(12, 8), square = tiny_scene(16, 16);
  const Picture expected[] = {serial_picture(small), serial_picture(square)};
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::map<std::string, std::uint64_t> answers;
  std::uint64_t deadlocks = 0;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    Trial t = trial_of(seed);
    t.job.returns = ReturnsMode::kSender;
    if (seed % 2 == 0 && !t.is_square) t.job.partition = PartitionMode::kRegular;
    INFO("seed " << seed << ": " << t.name() << ", " << t.farm.nodes << " nodes, scatter "
                 << t.job.scatter);
    RandomFarm farm(t.farm);
    const Outcome outcome = farm.render(t.is_square ? square : small, t.job);
    if (t.job.flow == FlowMode::kBlocking && outcome.failed) {
      ++deadlocks;
      CHECK(outcome.failed->code == FailureCode::kDeadlock);
      continue;
    }
    check_same_picture(farm, outcome, 1, expected[t.is_square ? 1 : 0]);
    // Of the rays that cross links only primary ones, on their way to their first hit, have none.
    const std::uint64_t answered = total(outcome, &control::NodeStats::answers);
    CHECK(answered <= total(outcome, &control::NodeStats::rays_in));
    if (t.job.partition == PartitionMode::kRegular)
      CHECK(answered == total(outcome, &control::NodeStats::rays_in));
    answers[t.name()] += answered;
  }
  if (only != 0 || last < kSeeds) return;
  CHECK(deadlocks > 0);
  std::size_t ways_with_answers = 0;
  for (const auto& [way, count] : answers) ways_with_answers += count > 0;
  CHECK(ways_with_answers > 12);
}

TEST_CASE("AOVs, samples and neighbours' help go together with light that goes back") {
  std::uint64_t taken_over = 0, answers = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const std::string text = scene_text(seed % 2 == 0 ? 144 : 48, seed % 2 == 0 ? 96 : 32);
    RandomFarmOptions how{.nodes = 1u << (1 + seed % 4),
                          .threads = static_cast<std::uint32_t>(1 + seed % 3),
                          .seed = seed};
    how.limits.window_tiles = 1 + static_cast<std::uint32_t>(seed % 3);
    control::JobOptions options = back_to_senders();
    options.partition = PartitionMode::kAuto;
    options.shadows = seed % 3 == 0 ? ShadowMode::kHorizon : ShadowMode::kForward;
    options.scatter = static_cast<std::uint32_t>(seed % 3);
    options.aov = "depth,normal,albedo,object";
    if (seed % 5 == 0) options.sums = SumsMode::kTree;
    INFO("seed " << seed << ", " << how.nodes << " nodes");
    RandomFarm farm(how);
    const Outcome outcome = farm.render(text, options);
    check_same_picture(farm, outcome, 1, serial_picture(text, AovSet::all()));
    taken_over += total(outcome, &control::NodeStats::tiles_taken_over) +
                  total(outcome, &control::NodeStats::rays_taken_over);
    answers += total(outcome, &control::NodeStats::answers);
  }
  CHECK(taken_over > 24);
  CHECK(answers > 10000);
}

TEST_CASE("statistics tell what light took that went back, and that none did") {
  const std::string text = scene_text(48, 32);
  for (const ReturnsMode returns : {ReturnsMode::kFrontal, ReturnsMode::kSender}) {
    control::JobOptions options = back_to_senders();
    options.returns = returns;
    options.shadows = ShadowMode::kForward;
    options.partition = PartitionMode::kRegular;
    RandomFarm farm({.nodes = 8});
    const Outcome outcome = farm.render(text, options);
    REQUIRE(outcome.done);
    const auto stats = nlohmann::json::parse(outcome.done->stats.text);
    const bool is_back = returns == ReturnsMode::kSender;
    CHECK(stats["choices"]["returns"] == to_string(returns));
    CHECK((stats["messages"]["answer_batches"] > 0) == is_back);
    CHECK((stats["messages"]["answer_bytes"] > 0) == is_back);
    std::uint64_t rays_in = 0, answers = 0, open_peak = 0, open_bytes_peak = 0;
    for (const auto& node : stats["per_node"]) {
      rays_in += node["rays_in"].get<std::uint64_t>();
      answers += node["answers"].get<std::uint64_t>();
      open_peak += node["open_peak"].get<std::uint64_t>();
      open_bytes_peak += node["open_bytes_peak"].get<std::uint64_t>();
    }
    CHECK(answers == (is_back ? rays_in : 0));
    CHECK((open_peak > 0) == is_back);
    CHECK((open_bytes_peak >= 8 * open_peak) == true);
    CHECK((open_bytes_peak > 0) == is_back);
  }
}
