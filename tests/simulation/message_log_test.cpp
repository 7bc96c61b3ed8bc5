// All messages between nodes and the frontal, with their times and order, as one number, which
// changes with any change of the brains' behaviour. A change of that on purpose, or of what tracing
// counts, records the new numbers. GRAYCUBE_SEEDS=2000 compares so many seeds, GRAYCUBE_SEED=S
// prints the number of that one.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <span>

#include "catch.hpp"
#include "proto/control.hpp"
#include "simulation/pictures.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr std::uint64_t kSeeds = 300, kManySeeds = 2000;

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits).
class Digest {
 public:
  void add(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes)
      value_ = (value_ ^ std::to_integer<std::uint64_t>(b)) * 0x100000001B3;
  }
  void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325;
};

/// A digest of all messages that are sent on a farm.
class MessageLog {
 public:
  explicit MessageLog(Farm& farm) {
    farm.on_sent = [this](Place from, Place to, double sent_s, const Message& m) {
      add(from, to, sent_s, m);
    };
  }
  std::uint64_t value() const { return digest_.value(); }

 private:
  void add(Place from, Place to, double sent_s, const Message& message) {
    digest_.add(std::bit_cast<std::uint64_t>(sent_s));
    for (const Place place : {from, to}) digest_.add(place ? place->value : kFrontalRank);
    digest_.add(message.frame.size());
    digest_.add(comparable(message).frame);
    digest_.add(message.payload.bytes());
  }
  /// The message without memory sizes, which depend on the standard library.
  static Message comparable(const Message& message) {
    if (looks_like_batch(message.frame)) return message;
    auto decoded = decode(message.text());
    auto* m = std::get_if<ControlMessage>(&decoded);
    auto* report = m == nullptr ? nullptr : std::get_if<control::NodeReport>(m);
    if (report == nullptr) return message;
    report->stats.memory_bytes = 0;
    return Message::of_text(encode(*m));
  }

  Digest digest_;
};

std::uint64_t log_of_trial(std::uint64_t seed) {
  const Trial t = trial_of(seed);
  RandomFarm farm(t.farm);
  const MessageLog log(farm);
  farm.render(t.is_square ? tiny_scene(16, 16) : tiny_scene(12, 8), t.job);
  return log.value();
}

struct Help {
  std::uint64_t log = 0, tiles = 0, rays = 0;
};

/// Options for larger pictures, whose nodes help each other.
Help help_of(std::uint64_t seed) {
  RandomFarmOptions how{
      .nodes = 2u << seed % 4, .threads = static_cast<std::uint32_t>(1 + seed % 3), .seed = seed};
  how.link_delay_s = seed % 2 == 0 ? 1e-3 : 1e-2;
  control::JobOptions job;
  job.algorithm = Algorithm::kMacro;
  job.partition = PartitionMode::kAuto;
  job.shadows = seed % 2 == 0 ? ShadowMode::kHorizon : ShadowMode::kForward;
  if (seed % 3 == 0) job.aov = "depth,normal,albedo,object";
  if (seed % 5 == 0) job.sums = SumsMode::kTree;
  RandomFarm farm(how);
  const MessageLog log(farm);
  Help help;
  for (const control::NodeStats& n : farm.render(scene_text(192, 128), job).reports) {
    help.tiles += n.tiles_taken_over;
    help.rays += n.rays_taken_over;
  }
  help.log = log.value();
  return help;
}

}  // namespace

TEST_CASE("the same seeds make nodes and frontal say the same as ever, at the same moments") {
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  if (only != 0) {
    std::printf("seed %llu: 0x%016llX\n", static_cast<unsigned long long>(only),
                static_cast<unsigned long long>(log_of_trial(only)));
    return;
  }
  const std::uint64_t last = number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  Digest digest;
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    digest.add(log_of_trial(seed));
    if (seed == kSeeds) CHECK(digest.value() == 0x8150BCA7673A20EE);
    if (seed == kManySeeds) CHECK(digest.value() == 0x3DB7DE7012E282A2);
  }
}

TEST_CASE("nodes that help each other say the same as ever, at the same moments") {
  Digest digest;
  std::uint64_t tiles = 0, rays = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Help help = help_of(seed);
    digest.add(help.log);
    tiles += help.tiles;
    rays += help.rays;
  }
  CHECK(tiles > 40);
  CHECK(rays > 100);
  CHECK(digest.value() == 0xCB8883AF55CF00E0);
}
