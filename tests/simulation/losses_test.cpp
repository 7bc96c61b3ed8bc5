// Whatever is lost while a picture is rendered, by seed: the picture is the serial one.
#include <algorithm>
#include <functional>
#include <map>

#include "catch.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

/// A trial in which silence is noticed, and no number of faults is too large.
Trial trial_with_faults(std::uint64_t seed) {
  Trial t = trial_of(seed);
  t.farm.silence_s = 3 * t.farm.heartbeat_s;
  t.farm.retries = kMaxRetries;
  return t;
}

/// Some of the ways that trials leave alone.
void draw_rarer_ways(Trial& t, std::mt19937_64& random) {
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  t.job.mesh = static_cast<MeshMode>(below(4));
  t.job.returns = static_cast<ReturnsMode>(below(2));
  if (t.job.flow == FlowMode::kBlocking) t.job.fifo = static_cast<FifoMode>(below(2));
  t.job.subdivision.way = static_cast<Subdivision>(below(6));
  if (t.job.mesh == MeshMode::k2d && t.job.shadows != ShadowMode::kLocal && below(2) == 0) {
    t.job.boundaries = BoundariesMode::kSliding;
    t.job.scatter = 0;
  }
}

std::string ways_of(const Trial& t) {
  return t.name() + " " + std::string(to_string(t.job.mesh)) + " " +
         std::string(to_string(t.job.returns)) + " " + std::string(to_string(t.job.boundaries)) +
         " " + std::string(to_string(t.job.fifo)) + ", " + std::to_string(t.farm.nodes) + " nodes";
}

using Draw = std::function<Fault(std::mt19937_64&, const Trial&)>;

/// Deaths and stops of any node, at a moment from 0 to 1 of the time that the job takes.
Fault death_or_stop(std::mt19937_64& random, const Trial& t) {
  Fault fault;
  fault.kind = random() % 2 == 0 ? Fault::Kind::kDeath : Fault::Kind::kStop;
  fault.rank = Rank{static_cast<std::uint32_t>(random() % t.farm.nodes)};
  return fault;
}

/// A link between two nodes that loses what is sent for a while; or the way of a node to the
/// frontal, for so long that the node is missed.
Fault cut(std::mt19937_64& random, const Trial& t) {
  Fault fault;
  fault.kind = Fault::Kind::kCut;
  fault.rank = Rank{static_cast<std::uint32_t>(random() % t.farm.nodes)};
  const Hypercube cube = *Hypercube::of_size(t.farm.nodes);
  const auto bit = static_cast<std::uint32_t>(random() % (cube.dimension() + 1));
  if (bit < cube.dimension()) fault.to = cube.neighbour(fault.rank, bit);
  fault.lasts_s = fault.to
                      ? t.farm.link_delay_s * std::uniform_real_distribution<double>(0, 20)(random)
                      : 2 * t.farm.silence_s;
  return fault;
}

enum class Starts : std::uint8_t {
  kAlways,
  kUntilSomeMoment,  ///< then no process can be started any more
};

Fault no_more_starts(std::mt19937_64& random, double takes_s) {
  Fault fault;
  fault.kind = Fault::Kind::kNoMoreStarts;
  fault.after_s = std::uniform_real_distribution<double>(0, takes_s / 2)(random);
  return fault;
}

/// Whether nobody was left to go on, which the farm has said.
bool has_given_up(const RandomFarm& farm, const Outcome& outcome) {
  return outcome.failed && farm.nodes_by_process().empty() &&
         farm.fatal_error().find("no more processes") != std::string::npos;
}

bool has_shared_process(const RandomFarm& farm) {
  return std::ranges::any_of(farm.nodes_by_process(), [](std::size_t nodes) { return nodes > 1; });
}

/// Renders seed by seed, with one to three faults each, and compares with the serial picture.
void check_seeds(std::uint64_t seeds, bool rarer_ways, const Draw& draw,
                 Starts starts = Starts::kAlways) {
  const std::uint64_t first = number_in_environment("GRAYCUBE_FIRST_SEED", 1);
  seeds = number_in_environment("GRAYCUBE_SEEDS", seeds);
  std::map<bool, Picture> expected;
  std::uint64_t epochs = 0, shared = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    Trial t = trial_with_faults(seed);
    std::mt19937_64 random(seed + 1'000'000);
    if (rarer_ways) draw_rarer_ways(t, random);
    INFO("seed " << seed << ", " << ways_of(t));
    const std::string text = tiny_scene(12, t.is_square ? 12 : 8);
    if (!expected.contains(t.is_square)) expected.emplace(t.is_square, serial_picture(text));
    // How long the job takes without faults tells when they can happen.
    RandomFarm whole(t.farm);
    const Outcome without = whole.render(text, t.job);
    if (without.failed) continue;  // ways that don't go together
    const double takes_s = std::max(without.render_s, t.farm.link_delay_s);
    // A farm that has never been whole gives up when processes can't be started.
    RandomFarm fresh(t.farm);
    RandomFarm& farm = starts == Starts::kAlways ? fresh : whole;
    const std::uint32_t job = starts == Starts::kAlways ? 1 : 2;
    if (starts == Starts::kUntilSomeMoment) farm.will_happen(no_more_starts(random, takes_s));
    for (std::uint64_t i = 0; i <= seed % 3; ++i) {
      Fault fault = draw(random, t);
      fault.after_s = std::uniform_real_distribution<double>(0, 1.5 * takes_s)(random);
      farm.will_happen(fault);
    }
    const Outcome outcome = farm.render(text, t.job);
    // As in 1987 the blocking flow may deadlock, with faults or without.
    if (outcome.failed && outcome.failed->code == FailureCode::kDeadlock) continue;
    if (starts == Starts::kUntilSomeMoment && has_given_up(farm, outcome)) continue;
    INFO("the farm: " << farm.fatal_error());
    check_same_picture(farm, outcome, job, expected.at(t.is_square));
    epochs += outcome.epochs;
    shared += has_shared_process(farm) ? 1 : 0;
  }
  CHECK(epochs > seeds / (starts == Starts::kAlways ? 1 : 2));
  if (starts == Starts::kUntilSomeMoment) CHECK(shared > seeds / 8);
}

}  // namespace

TEST_CASE("deaths and stops at any moment leave the picture as it is") {
  check_seeds(1000, false, death_or_stop);
}

TEST_CASE("so they do in every mesh, with light that returns, and boundaries that slide") {
  check_seeds(1000, true, death_or_stop);
}

TEST_CASE("what a link loses is traced again") { check_seeds(1000, false, cut); }

TEST_CASE("where no process can be started any more, nodes that are left take others in") {
  check_seeds(500, true, death_or_stop, Starts::kUntilSomeMoment);
}

TEST_CASE("so they do when links are cut") {
  check_seeds(300, false, cut, Starts::kUntilSomeMoment);
}
