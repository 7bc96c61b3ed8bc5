// Along random rays a scene of touching surfaces shows what the same solids show without any.
#include <cstdlib>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "coincidence/pair_models.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::size_t kRays = 120;

std::uint64_t number_in_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// Pairs of all kinds in turn: GRAYCUBE_SEEDS=N for more of them, GRAYCUBE_SEED=S for one.
template <typename Make>
void check_pairs(std::uint64_t count, const Make& make, bool forgives_skins = false) {
  const std::uint64_t one = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t first = one > 0 ? one : 1;
  const std::uint64_t last = one > 0 ? one : number_in_environment("GRAYCUBE_SEEDS", count);
  Tally sum;
  std::size_t wrong_pairs = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    const FlushPair pair = make(seed);
    const Tally tally = PairOfModels(pair, {.forgives_skins = forgives_skins}).compare(kRays);
    sum.add(tally);
    if (tally.wrong == 0) continue;
    if (++wrong_pairs <= 5) UNSCOPED_INFO(tally.first);
  }
  INFO(sum.wrong << " of " << sum.rays << " rays, " << sum.near_edges << " more near edges; "
                 << wrong_pairs << " pairs of " << last - first + 1);
  CHECK(wrong_pairs == 0);
  if (one > 0) return;
  CHECK(sum.met * 3 > sum.rays);
  // Differences near edges are rare.
  CHECK(sum.near_edges * 1000 <= sum.rays);
}

FlushPair any_pair(std::uint64_t seed) { return PairMaker(seed).make(); }

}  // namespace

TEST_CASE("touching surfaces leave no skin under quarter turns, where all arithmetic is exact") {
  check_pairs(500, [](std::uint64_t seed) {
    return PairMaker(seed, {.turns = ChainOptions::Turns::kQuarters}).make();
  });
}

TEST_CASE("touching surfaces leave no skin under rotations and translations") {
  check_pairs(1000, [](std::uint64_t seed) {
    return PairMaker(seed, {.turns = ChainOptions::Turns::kRigid, .is_any_size = false}).make();
  });
}

TEST_CASE("touching surfaces leave no skin under any maps, of any size, far from the origin too") {
  check_pairs(2500, any_pair);
}

TEST_CASE("a round surface is one, whatever kind of shape it is written as") {
  check_pairs(1000, [](std::uint64_t seed) {
    return PairMaker(seed, {.is_any_size = false, .tells_across_kinds = true}).make();
  });
}

TEST_CASE("the two scenes of a pair hold the same solids but for skins") {
  check_pairs(1000, any_pair, true);
  const auto across_kinds = [](std::uint64_t seed) {
    return PairMaker(seed, {.tells_across_kinds = true}).make();
  };
  check_pairs(1000, across_kinds, true);
}

TEST_CASE("solids without touching surfaces are the same whichever way leads to them") {
  check_pairs(1000, [](std::uint64_t seed) {
    FlushPair pair = any_pair(seed);
    pair.flush = PairMaker(seed, {.tells_longer_anew = true}).make().longer;
    return pair;
  });
}

/// Only run by its name: prints a table of how many pairs of each kind fail.
TEST_CASE("how many pairs of each kind fail", "[.][measure]") {
  const std::uint64_t count = number_in_environment("GRAYCUBE_SEEDS", 100);
  std::ostringstream table;
  for (const auto& [name, options] :
       {std::pair{"exact", PairOptions{ChainOptions::Turns::kQuarters, false}},
        std::pair{"rigid", PairOptions{ChainOptions::Turns::kRigid, false}},
        std::pair{"any", PairOptions{}}}) {
    for (std::size_t kind = 0; kind < kPairKinds; ++kind) {
      Tally sum;
      std::size_t wrong = 0;
      double ulps = 0;
      for (std::uint64_t seed = 1; seed <= count; ++seed) {
        const FlushPair pair = PairMaker(seed, static_cast<PairKind>(kind), options).make();
        const Tally tally = PairOfModels(pair).compare(kRays);
        sum.add(tally);
        wrong += tally.wrong > 0 ? 1 : 0;
        ulps = std::fmax(ulps, pair.ways_differ_ulps);
      }
      table << '\n'
            << name << '\t' << kPairNames[kind] << "\t" << wrong << " of " << count << " pairs\t"
            << sum.wrong << " of " << sum.rays << " rays\t" << sum.near_edges << " near edges\tmet "
            << sum.met << "\tways differ by " << ulps << " ulps";
      if (sum.wrong > 0) table << "\n    " << sum.first;
    }
  }
  WARN(table.str());
}
