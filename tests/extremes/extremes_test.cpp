// Scenes of extreme numbers: each is refused with a reason, by the command and by a farm alike, or
// rendered by both alike. GRAYCUBE_SEEDS=N tries N of them, GRAYCUBE_SEED=S only that one.
#include <cstdint>
#include <map>

#include "catch.hpp"
#include "extremes/extreme_trial.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::testing;
using simulation::number_in_environment;

namespace {

constexpr std::uint64_t kSeeds = 800;

}  // namespace

TEST_CASE("scenes of extreme numbers are refused with a reason, or rendered alike by all") {
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::map<ExtremeEnd, std::uint64_t> ends;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    INFO("seed " << seed);
    ++ends[try_extreme(seed, ExtremeScene(seed).text())];
  }
  if (only != 0 || last < kSeeds) return;
  // The seeds reach every end often enough for that to mean something.
  CHECK(ends[ExtremeEnd::kUnread] > last / 20);
  CHECK(ends[ExtremeEnd::kUncompiled] > last / 20);
  CHECK(ends[ExtremeEnd::kPlain] > last / 40);
  CHECK(ends[ExtremeEnd::kPicture] > last / 5);
}
