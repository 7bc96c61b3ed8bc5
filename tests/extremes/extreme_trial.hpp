// One scene of extreme numbers, checked and rendered in the ways that its seed decides.
#pragma once

#include <algorithm>
#include <string>

#include "extremes/extreme_scene.hpp"
#include "scene/scene_fault.hpp"
#include "simulation/pictures.hpp"

namespace graycube::testing {

enum class ExtremeEnd {
  kUnread,      ///< refused by the reader
  kUncompiled,  ///< refused when it is compiled
  kPlain,       ///< rendered, to one colour
  kPicture,     ///< rendered
};

/// How a farm renders the seed's scene.
struct ExtremeFarm {
  simulation::RandomFarmOptions farm;
  control::JobOptions job;
};

inline ExtremeFarm extreme_farm(std::uint64_t seed) {
  Dice dice(seed ^ 0xFA53ull);
  ExtremeFarm f;
  f.farm.seed = seed;
  f.farm.nodes = 1u << dice.below(4);
  f.farm.heartbeat_s = 100;
  f.job.algorithm = dice.one_in(6) ? Algorithm::kRoth : Algorithm::kMacro;
  f.job.shadows = static_cast<ShadowMode>(dice.below(3));
  f.job.scatter = static_cast<std::uint32_t>(1 + dice.below(2));
  if (dice.one_in(3)) {
    f.job.partition = PartitionMode::kBalanced;
    f.job.scatter = 1;
    f.farm.nodes = std::min(f.farm.nodes, 2u);
  }
  if (dice.one_in(2)) f.farm.replica_bytes = 0;
  return f;
}

inline bool has_one_color(const Picture& picture) {
  for (std::size_t i = 3; i < picture.rgb.size(); ++i) {
    if (picture.rgb[i] != picture.rgb[i % 3]) return false;
  }
  return true;
}

/// Checks that a farm refuses the scene if the reader or the compiler does, and else renders the
/// picture that `serial` does.
inline ExtremeEnd try_extreme(std::uint64_t seed, const std::string& text) {
  const ReadResult read = read_scene_text(text);
  ExtremeEnd end = read.scene ? ExtremeEnd::kPicture : ExtremeEnd::kUnread;
  if (read.scene) {
    try {
      compile_scene(*read.scene);
    } catch (const UnrenderableScene& e) {
      end = ExtremeEnd::kUncompiled;
      for (const SceneFault& f : e.faults()) CHECK((f.pointer.empty() || f.pointer[0] == '/'));
    }
  }
  // Farms refuse in the same way, of which a few are proof enough.
  if (end == ExtremeEnd::kUnread && seed % 16 != 0) return end;
  const ExtremeFarm how = extreme_farm(seed);
  simulation::RandomFarm farm(how.farm);
  const simulation::Outcome outcome = farm.render(text, how.job);
  if (end != ExtremeEnd::kPicture) {
    REQUIRE(outcome.failed);
    CHECK(outcome.failed->code == FailureCode::kBadInput);
    CHECK_FALSE(outcome.failed->errors.empty());
    return end;
  }
  const Picture expected = simulation::serial_picture(text);
  simulation::check_same_picture(farm, outcome, 1, expected);
  return has_one_color(expected) ? ExtremeEnd::kPlain : end;
}

}  // namespace graycube::testing
