#include "regions/rectilinear.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "catch.hpp"

using namespace graycube;

namespace {

LoadMap random_map(std::mt19937_64& random, std::uint32_t columns, std::uint32_t rows) {
  LoadMap map(columns, rows);
  for (double& load : map.load) {
    load = static_cast<double>(random() % 100);
    if (random() % 8 == 0) load *= 30;
  }
  return map;
}

void check_cuts(const std::vector<std::uint32_t>& cuts, std::uint32_t cells, std::uint32_t parts) {
  REQUIRE(cuts.size() == parts - 1);
  std::uint32_t before = 0;
  for (const std::uint32_t cut : cuts) {
    REQUIRE(cut > before);
    REQUIRE(cut < cells);
    before = cut;
  }
}

/// The best of all ways to cut one row of cells.
double best_by_trial(const LoadMap& map, std::uint32_t parts) {
  double best = std::numeric_limits<double>::infinity();
  std::vector<bool> cut(map.columns - 1, false);
  std::fill(cut.end() - (parts - 1), cut.end(), true);
  do {
    RectilinearCuts cuts;
    for (std::uint32_t i = 0; i < cut.size(); ++i) {
      if (cut[i]) cuts.columns.push_back(i + 1);
    }
    best = std::min(best, heaviest(map, cuts));
  } while (std::next_permutation(cut.begin(), cut.end()));
  return best;
}

}  // namespace

TEST_CASE("balanced cuts are cuts, and never heavier than even ones") {
  std::mt19937_64 random(1);
  double saved = 0;
  for (int i = 0; i < 300; ++i) {
    const auto columns = static_cast<std::uint32_t>(1 + random() % 20);
    const auto rows = static_cast<std::uint32_t>(1 + random() % 20);
    const auto column_parts = static_cast<std::uint32_t>(1 + random() % columns);
    const auto row_parts = static_cast<std::uint32_t>(1 + random() % rows);
    const LoadMap map = random_map(random, columns, rows);
    const RectilinearCuts cuts = balanced_cuts(map, column_parts, row_parts);
    check_cuts(cuts.columns, columns, column_parts);
    check_cuts(cuts.rows, rows, row_parts);
    const double even = heaviest(map, even_cuts(map, column_parts, row_parts));
    REQUIRE(heaviest(map, cuts) <= even);
    saved += 1 - heaviest(map, cuts) / std::max(1.0, even);
  }
  CHECK(saved > 15);
}

TEST_CASE("a single row is cut as well as can be") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const LoadMap map = random_map(random, 10, 1);
    const auto parts = static_cast<std::uint32_t>(1 + random() % 6);
    CHECK(heaviest(map, balanced_cuts(map, parts, 1)) <= best_by_trial(map, parts) + 1e-6);
  }
}

TEST_CASE("an empty map is cut too") {
  const LoadMap map(8, 4);
  check_cuts(balanced_cuts(map, 8, 2).columns, 8, 8);
}
