#include "regions/jagged.hpp"

#include <algorithm>
#include <numeric>

#include "catch.hpp"
#include "csg/dice.hpp"

using namespace graycube;
using graycube::testing::Dice;

namespace {

std::vector<std::int64_t> even_edges(std::uint32_t cells, std::int64_t side) {
  std::vector<std::int64_t> edges;
  for (std::int64_t i = 0; i <= cells; ++i) edges.push_back(i * side / cells);
  return edges;
}

void check_line(std::span<const std::int64_t> edges, std::int64_t side) {
  std::int64_t before = 0;
  for (const std::int64_t edge : edges) {
    REQUIRE(edge > before);
    REQUIRE(edge < side);
    before = edge;
  }
}

/// The load of each part, if pixels share their cell's load evenly.
std::vector<double> loads_of(const LoadMap& map, const std::vector<std::int64_t>& x,
                             const std::vector<std::int64_t>& y, const JaggedCuts& cuts,
                             std::size_t columns) {
  std::vector<double> loads(columns * (cuts.rows.size() + 1));
  for (std::uint32_t r = 0; r < map.rows; ++r) {
    for (std::uint32_t c = 0; c < map.columns; ++c) {
      const double each = map.at(c, r) / static_cast<double>((x[c + 1] - x[c]) * (y[r + 1] - y[r]));
      for (std::int64_t py = y[r]; py < y[r + 1]; ++py) {
        const auto row =
            std::upper_bound(cuts.rows.begin(), cuts.rows.end(), py) - cuts.rows.begin();
        const auto edges = std::span(cuts.columns)
                               .subspan(static_cast<std::size_t>(row) * (columns - 1), columns - 1);
        for (std::int64_t px = x[c]; px < x[c + 1]; ++px) {
          const auto column = std::upper_bound(edges.begin(), edges.end(), px) - edges.begin();
          loads[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] += each;
        }
      }
    }
  }
  return loads;
}

}  // namespace

TEST_CASE("jagged cuts are cuts, whatever the loads") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto some = [&](std::size_t most) {
      return static_cast<std::uint32_t>(1 + dice.below(most));
    };
    LoadMap map(some(12), some(12));
    const std::int64_t width = map.columns + dice.below(100), height = map.rows + dice.below(100);
    const std::size_t kind = dice.below(3);
    for (double& load : map.load)
      load = kind == 0 ? 0 : dice.one_in(kind == 1 ? 20 : 2) ? dice.between(0, 1000) : 0;
    const auto columns =
        static_cast<std::uint32_t>(1 + dice.below(static_cast<std::size_t>(width)));
    const auto rows = static_cast<std::uint32_t>(1 + dice.below(static_cast<std::size_t>(height)));
    const JaggedCuts cuts = jagged_cuts(map, even_edges(map.columns, width),
                                        even_edges(map.rows, height), columns, rows);
    REQUIRE(cuts.rows.size() == rows - 1);
    check_line(cuts.rows, height);
    REQUIRE(cuts.columns.size() == std::size_t{columns - 1} * rows);
    for (std::uint32_t r = 0; r < rows; ++r)
      check_line(std::span(cuts.columns).subspan(r * (columns - 1), columns - 1), width);
    const auto mean = mean_columns(cuts, columns);
    REQUIRE(mean.size() == columns - 1);
    check_line(mean, width);
  }
}

TEST_CASE("parts of a jagged cut are as heavy as each other, but for the width of a packet") {
  double worst_regular = 1;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    LoadMap map(32, 32);
    // The load is a floor of work with hills on it.
    const double x0 = dice.between(0, 32), y0 = dice.between(0, 32);
    for (std::uint32_t r = 0; r < 32; ++r) {
      for (std::uint32_t c = 0; c < 32; ++c)
        map.at(c, r) = 1 + 200 / (4 + (c - x0) * (c - x0) + (r - y0) * (r - y0));
    }
    const auto edges = even_edges(32, 512);
    const auto heaviest_part = [&](const JaggedCuts& cuts) {
      const auto loads = loads_of(map, edges, edges, cuts, 4);
      return *std::max_element(loads.begin(), loads.end()) * 16 /
             std::accumulate(loads.begin(), loads.end(), 0.0);
    };
    REQUIRE(heaviest_part(jagged_cuts(map, edges, edges, 4, 4)) < 1.15);
    worst_regular =
        std::max(worst_regular,
                 heaviest_part({{128, 256, 384},
                                {128, 256, 384, 128, 256, 384, 128, 256, 384, 128, 256, 384}}));
  }
  CHECK(worst_regular > 2);
}

TEST_CASE(
    "a line is cut where its parts weigh the same, or by pixels where nothing weighs anything") {
  LoadMap map(4, 1);
  const std::vector<std::int64_t> x{0, 100, 200, 300, 400}, y{0, 10};
  CHECK(jagged_cuts(map, x, y, 4, 1).columns == std::vector<std::int64_t>{100, 200, 300});
  map.load = {0, 3, 1, 0};
  CHECK(jagged_cuts(map, x, y, 2, 1).columns == std::vector<std::int64_t>{168});
  map.load = {8, 0, 0, 0};
  CHECK(jagged_cuts(map, x, y, 4, 1).columns == std::vector<std::int64_t>{24, 52, 76});
  map.load = {0, 0, 0, 1};
  CHECK(jagged_cuts(map, x, y, 2, 2).columns == std::vector<std::int64_t>{352, 352});
  CHECK(mean_columns({{5}, {10, 30, 21, 40}}, 3) == std::vector<std::int64_t>{15, 35});
  CHECK(mean_columns({{5}, {}}, 1).empty());
}
