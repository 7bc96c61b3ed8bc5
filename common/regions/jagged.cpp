#include "regions/jagged.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "check.hpp"

namespace graycube {
namespace {

/// Appends the edges between equally heavy parts of a line of cells; by pixels where nothing weighs
/// anything.
void cut_line(std::vector<double> loads, std::span<const std::int64_t> ends, std::uint32_t parts,
              std::vector<std::int64_t>& edges) {
  double total = std::accumulate(loads.begin(), loads.end(), 0.0);
  if (!(total > 0)) {
    for (std::size_t i = 0; i < loads.size(); ++i)
      loads[i] = static_cast<double>(ends[i + 1] - ends[i]);
    total = static_cast<double>(ends.back() - ends.front());
  }
  std::size_t cell = 0;
  double before = 0;
  std::int64_t last = ends.front();
  for (std::uint32_t part = 1; part < parts; ++part) {
    const double wanted = total * part / parts;
    while (cell + 1 < loads.size() && before + loads[cell] < wanted) before += loads[cell++];
    const double in_cell =
        loads[cell] > 0 ? std::clamp((wanted - before) / loads[cell], 0.0, 1.0) : 0.0;
    const double place = static_cast<double>(ends[cell]) +
                         in_cell * static_cast<double>(ends[cell + 1] - ends[cell]);
    const auto step = static_cast<std::int64_t>(std::lround(place / kCutStep)) * kCutStep;
    // A pixel at least for this part, and for each to come.
    last = std::clamp(step, last + 1, ends.back() - (parts - part));
    edges.push_back(last);
  }
}

}  // namespace

JaggedCuts jagged_cuts(const LoadMap& map, std::span<const std::int64_t> x,
                       std::span<const std::int64_t> y, std::uint32_t column_parts,
                       std::uint32_t row_parts) {
  GRAYCUBE_CHECK(x.size() == map.columns + 1 && y.size() == map.rows + 1,
                 "%zu by %zu edges of cells", x.size(), y.size());
  GRAYCUBE_CHECK(
      column_parts >= 1 && column_parts <= x.back() && row_parts >= 1 && row_parts <= y.back(),
      "%u by %u parts", column_parts, row_parts);
  JaggedCuts cuts;
  std::vector<double> line(map.rows, 0);
  for (std::uint32_t r = 0; r < map.rows; ++r) {
    for (std::uint32_t c = 0; c < map.columns; ++c) line[r] += map.at(c, r);
  }
  cut_line(std::move(line), y, row_parts, cuts.rows);
  for (std::uint32_t part = 0; part < row_parts; ++part) {
    const std::int64_t top = part > 0 ? cuts.rows[part - 1] : y.front();
    const std::int64_t bottom = part + 1 < row_parts ? cuts.rows[part] : y.back();
    line.assign(map.columns, 0);
    for (std::uint32_t r = 0; r < map.rows; ++r) {
      const std::int64_t inside = std::min(bottom, y[r + 1]) - std::max(top, y[r]);
      if (inside <= 0) continue;
      const double share = static_cast<double>(inside) / static_cast<double>(y[r + 1] - y[r]);
      for (std::uint32_t c = 0; c < map.columns; ++c) line[c] += share * map.at(c, r);
    }
    cut_line(line, x, column_parts, cuts.columns);
  }
  return cuts;
}

std::vector<std::int64_t> mean_columns(const JaggedCuts& cuts, std::uint32_t column_parts) {
  std::vector<std::int64_t> mean(column_parts - 1, 0);
  if (mean.empty()) return mean;
  const std::size_t rows = cuts.columns.size() / mean.size();
  for (std::size_t i = 0; i < cuts.columns.size(); ++i) mean[i % mean.size()] += cuts.columns[i];
  // Edges of each row lie a pixel apart at least, and so do their means.
  for (std::int64_t& edge : mean) edge /= static_cast<std::int64_t>(rows);
  return mean;
}

}  // namespace graycube
