#include "regions/sliding_cuts.hpp"

#include <random>

#include "catch.hpp"

using namespace graycube;

namespace {

/// What is left of a picture of cells, `columns` × `rows` parts of which stay as they are.
WorkLeft left_of(std::uint32_t columns, std::uint32_t rows, std::uint32_t side, double each = 1) {
  WorkLeft left{LoadMap(side, side), LoadMap(columns, rows)};
  left.cells.load.assign(left.cells.load.size(), each);
  return left;
}

}  // namespace

TEST_CASE("where parts have as much left to do, boundaries stay") {
  const RectilinearCuts even{{4, 8, 12}, {8}};
  CHECK(slid_cuts(left_of(4, 2, 16), even, {}) == even);
}

TEST_CASE("a difference below the least ratio moves nothing, and one beyond it does") {
  WorkLeft left = left_of(2, 1, 16);
  const RectilinearCuts even{{8}, {}};
  left.parts.at(0, 0) = 128 * 0.2;
  CHECK(slid_cuts(left, even, {.least_ratio = 1.25}) == even);
  left.parts.at(0, 0) = 128 * 0.3;
  CHECK(slid_cuts(left, even, {.least_ratio = 1.25}) == RectilinearCuts{{7}, {}});
}

TEST_CASE("a boundary slides towards the part with much to do, by a part of the narrower side") {
  WorkLeft left = left_of(2, 1, 32, 0);
  for (std::uint32_t y = 0; y < 32; ++y) left.cells.at(0, y) = 1;
  CHECK(slid_cuts(left, {{20}, {}}, {.most_part = 0.25}) == RectilinearCuts{{20}, {}});
  for (std::uint32_t y = 0; y < 32; ++y) left.cells.at(18, y) = 1;
  // The narrower side has 12 cells: three are the most, two are enough.
  CHECK(slid_cuts(left, {{20}, {}}, {.most_part = 0.25}) == RectilinearCuts{{18}, {}});
  CHECK(slid_cuts(left, {{20}, {}}, {.most_part = 0.1}) == RectilinearCuts{{20}, {}});
}

TEST_CASE("rows slide as columns do") {
  WorkLeft left = left_of(1, 2, 16);
  left.parts.at(0, 1) = 1000;
  CHECK(slid_cuts(left, {{}, {8}}, {.most_part = 0.25}) == RectilinearCuts{{}, {10}});
}

TEST_CASE("no slide makes the heaviest part heavier, takes a part's last cell, or goes too far") {
  std::mt19937_64 random(11);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::uint64_t slid = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::uint32_t columns = 1 + below(5), rows = 1 + below(5), side = 5 + below(12);
    WorkLeft left = left_of(columns, rows, side);
    for (double& load : left.cells.load) load = below(4) == 0 ? below(100) : below(3);
    for (double& load : left.parts.load) load = below(3) == 0 ? below(400) : 0;
    const RectilinearCuts now = even_cuts(left.cells, columns, rows);
    const SlideRules rules{.least_ratio = 1 + below(100) / 50.0, .most_part = below(100) / 100.0};
    const RectilinearCuts cuts = slid_cuts(left, now, rules);
    const auto heaviest_of = [&](const RectilinearCuts& c) {
      double most = 0;
      for (std::uint32_t column = 0; column < columns; ++column) {
        for (std::uint32_t row = 0; row < rows; ++row) {
          double load = left.parts.at(column, row);
          const std::uint32_t x1 = column + 1 < columns ? c.columns[column] : side;
          const std::uint32_t y1 = row + 1 < rows ? c.rows[row] : side;
          for (std::uint32_t x = column > 0 ? c.columns[column - 1] : 0; x < x1; ++x) {
            for (std::uint32_t y = row > 0 ? c.rows[row - 1] : 0; y < y1; ++y)
              load += left.cells.at(x, y);
          }
          most = std::max(most, load);
        }
      }
      return most;
    };
    CHECK(heaviest_of(cuts) <= heaviest_of(now) * (1 + 1e-12));
    slid += cuts != now;
    for (const bool is_column : {true, false}) {
      const auto& before = is_column ? now.columns : now.rows;
      const auto& after = is_column ? cuts.columns : cuts.rows;
      REQUIRE(before.size() == after.size());
      for (std::size_t k = 0; k < after.size(); ++k) {
        CHECK(after[k] > (k == 0 ? 0 : after[k - 1]));
        CHECK(after[k] < side);
        const std::uint32_t step = std::max(after[k], before[k]) - std::min(after[k], before[k]);
        CHECK(step <= std::max(1.0, rules.most_part * side));
      }
    }
  }
  CHECK(slid > 1000);
}
