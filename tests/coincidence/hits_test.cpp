// Along random rays a scene of touching surfaces shows what the same solids show without any.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <sstream>
#include <string>

#include "coincidence/pair_rays.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// What came of the rays of some pairs.
struct Tally {
  std::size_t rays = 0, met = 0, wrong = 0;
  /// Differ within a hair's breadth of an edge, or nearly along a face.
  std::size_t near_edges = 0;
  /// The first wrong ray.
  std::string first;

  void add(const Tally& t) {
    rays += t.rays;
    met += t.met;
    wrong += t.wrong;
    near_edges += t.near_edges;
    if (first.empty()) first = t.first;
  }
};

/// Compares the two scenes of a pair.
class PairOfModels {
 public:
  /// `forgives_skins`: skins as thick as rounding makes them don't count.
  explicit PairOfModels(const FlushPair& pair, bool forgives_skins = false)
      : pair_(pair),
        forgives_skins_(forgives_skins),
        flush_model_(compile_scene(pair.flush)),
        longer_model_(compile_scene(pair.longer)),
        flush_(flush_model_),
        longer_(longer_model_),
        rays_(pair, pair.seed) {}

  Tally compare(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const PairRay ray = rays_.make(i);
      if (ray.starts_on_face && !PairRays::is_large_enough(ray)) continue;
      const auto expected = compare(ray);
      if (expected.empty() || !PairRays::is_large_enough(ray)) continue;
      compare(rays_.secondary(ray, ray.ray.at(expected[i % expected.size()].t)));
    }
    return tally_;
  }

 private:
  std::vector<SeenCrossing> compare(const PairRay& ray) {
    const auto expected = longer_.all(ray);
    auto found = flush_.all(ray);
    if (forgives_skins_) found = without_skins(found, 100 * tolerance(ray, found).t);
    ++tally_.rays;
    tally_.met += expected.empty() ? 0 : 1;
    if (same_crossings(expected, found, tolerance(ray, expected))) return expected;
    if (!is_clear_of_edges(ray, expected)) {
      ++tally_.near_edges;
      return expected;
    }
    if (++tally_.wrong == 1) tally_.first = describe(ray, expected, found);
    return expected;
  }

  static CrossingTolerance tolerance(const PairRay& ray, const std::vector<SeenCrossing>& expected) {
    const double farthest = expected.empty() ? 0 : expected.back().t;
    const double reach = max_abs(ray.ray.origin) + farthest;
    return {1e-9 * (ray.size + farthest) + 64 * std::numeric_limits<double>::epsilon() * reach, 1e-6};
  }

  /// Rays a millionth of the size beside it cross the same faces, none of them nearly along it.
  bool is_clear_of_edges(const PairRay& ray, const std::vector<SeenCrossing>& expected) {
    constexpr double kBeside = 1e-6;
    for (const SeenCrossing& c : expected) {
      if (c.cosine < kLeastGrazing) return false;
    }
    for (int i = 0; i < 8; ++i) {
      const auto around = longer_.all(rays_.beside(ray, kBeside));
      if (!same_crossings(expected, around, {1e-4 * (ray.size + 1e-3 * max_abs(ray.ray.origin)), 1e-2})) return false;
    }
    return true;
  }

  std::string describe(const PairRay& ray, const std::vector<SeenCrossing>& expected,
                       const std::vector<SeenCrossing>& found) const {
    std::ostringstream out;
    out.precision(17);
    const Vec3 &o = ray.ray.origin, &d = ray.ray.direction;
    out << pair_.text() << ": ray " << ray.what << " {{" << o.x << ", " << o.y << ", " << o.z << "}, {" << d.x << ", "
        << d.y << ", " << d.z << "}}, size " << ray.size << ", ways differ by " << pair_.ways_differ_ulps << " ulps";
    const auto list = [&](const char* name, const std::vector<SeenCrossing>& crossings) {
      out << "\n  " << name << ':';
      for (const SeenCrossing& c : crossings) out << ' ' << (c.entering ? "in " : "out ") << c.t;
    };
    list("expected", expected);
    list("found", found);
    return out.str();
  }

  const FlushPair& pair_;
  bool forgives_skins_;
  Model flush_model_, longer_model_;
  CrossingFinder flush_, longer_;
  PairRays rays_;
  Tally tally_;
};

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
    const Tally tally = PairOfModels(pair, forgives_skins).compare(kRays);
    sum.add(tally);
    if (tally.wrong == 0) continue;
    if (++wrong_pairs <= 5) UNSCOPED_INFO(tally.first);
  }
  INFO(sum.wrong << " of " << sum.rays << " rays, " << sum.near_edges << " more near edges; " << wrong_pairs << " pairs of "
                 << last - first + 1);
  CHECK(wrong_pairs == 0);
  CHECK(sum.met * 3 > sum.rays);
  // What differs near edges only is rare.
  CHECK(sum.near_edges * 1000 <= sum.rays);
}

FlushPair any_pair(std::uint64_t seed) { return PairMaker(seed).make(); }

}  // namespace

TEST_CASE("touching surfaces leave no skin under quarter turns, where all arithmetic is exact") {
  check_pairs(500, [](std::uint64_t seed) { return PairMaker(seed, {.turns = ChainOptions::Turns::kQuarters}).make(); });
}

TEST_CASE("touching surfaces leave no skin under rotations and translations") {
  check_pairs(1000, [](std::uint64_t seed) {
    return PairMaker(seed, {.turns = ChainOptions::Turns::kRigid, .is_any_size = false}).make();
  });
}

TEST_CASE("touching surfaces leave no skin under any maps, of any size, far from the origin too") {
  check_pairs(2500, any_pair);
}

TEST_CASE("the two scenes of a pair hold the same solids but for skins") { check_pairs(1000, any_pair, true); }

TEST_CASE("solids without touching surfaces are the same whichever way leads to them") {
  check_pairs(1000, [](std::uint64_t seed) {
    FlushPair pair = any_pair(seed);
    pair.flush = PairMaker(seed, {.tells_longer_anew = true}).make().longer;
    return pair;
  });
}

/// Run by name: a table of how many pairs of each kind fail.
TEST_CASE("how many pairs of each kind fail", "[.][measure]") {
  const std::uint64_t count = number_in_environment("GRAYCUBE_SEEDS", 100);
  std::ostringstream table;
  for (const auto& [name, options] : {std::pair{"exact", PairOptions{ChainOptions::Turns::kQuarters, false}},
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
      table << '\n' << name << '\t' << kPairNames[kind] << "\t" << wrong << " of " << count << " pairs\t" << sum.wrong
            << " of " << sum.rays << " rays\t" << sum.near_edges << " near edges\tmet " << sum.met << "\tways differ by "
            << ulps << " ulps";
      if (sum.wrong > 0) table << "\n    " << sum.first;
    }
  }
  WARN(table.str());
}
