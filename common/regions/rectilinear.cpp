#include "regions/rectilinear.hpp"

#include <algorithm>
#include <optional>

#include "check.hpp"

namespace graycube {
namespace {

/// More rounds than improvements ever take; each is a few thousand additions.
constexpr int kRounds = 12;
constexpr int kBisections = 40;

using Cuts = std::vector<std::uint32_t>;
/// Loads of one line of cells (a column or row), one for each part in the direction along it.
using Line = std::vector<double>;

std::vector<Line> lines_of(const LoadMap& map, bool by_column, const Cuts& other) {
  const std::uint32_t count = by_column ? map.columns : map.rows;
  const std::uint32_t across = by_column ? map.rows : map.columns;
  std::vector<Line> lines(count, Line(other.size() + 1, 0));
  for (std::uint32_t i = 0; i < count; ++i) {
    std::size_t part = 0;
    for (std::uint32_t j = 0; j < across; ++j) {
      if (part < other.size() && j == other[part]) ++part;
      lines[i][part] += by_column ? map.at(i, j) : map.at(j, i);
    }
  }
  return lines;
}

/// Cuts lines into `parts` parts of which none is heavier than `limit` anywhere; nothing if there
/// is no such cut. Each part but the last is as long as it may be, and leaves a line for each part
/// to come.
std::optional<Cuts> cuts_within(const std::vector<Line>& lines, std::size_t parts, double limit) {
  Cuts cuts;
  Line sum(lines.front().size(), 0);
  std::size_t begun = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    bool fits = true;
    for (std::size_t p = 0; p < sum.size(); ++p) {
      if (lines[i][p] > limit) return std::nullopt;
      fits = fits && sum[p] + lines[i][p] <= limit;
    }
    const std::size_t parts_left = parts - 1 - cuts.size();
    const bool must_cut = i > begun && lines.size() - i <= parts_left;
    if (i > begun && (!fits || must_cut)) {
      if (parts_left == 0) return std::nullopt;
      cuts.push_back(static_cast<std::uint32_t>(i));
      std::fill(sum.begin(), sum.end(), 0);
      begun = i;
    }
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += lines[i][p];
  }
  return cuts.size() + 1 == parts ? std::optional(cuts) : std::nullopt;
}

Cuts best_cuts(const std::vector<Line>& lines, std::size_t parts) {
  double total = 0;
  for (const Line& line : lines) {
    for (const double load : line) total += load;
  }
  // Made a little larger, since a sum in another order may round differently.
  double low = 0, high = total * (1 + 1e-9) + 1e-300;
  Cuts best = cuts_within(lines, parts, high).value();
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    if (auto cuts = cuts_within(lines, parts, middle)) {
      best = *std::move(cuts);
      high = middle;
    } else {
      low = middle;
    }
  }
  return best;
}

Cuts even(std::uint32_t cells, std::uint32_t parts) {
  GRAYCUBE_CHECK(parts >= 1 && parts <= cells, "%u parts of %u cells", parts, cells);
  Cuts cuts;
  for (std::uint64_t i = 1; i < parts; ++i)
    cuts.push_back(static_cast<std::uint32_t>(i * cells / parts));
  return cuts;
}

}  // namespace

RectilinearCuts even_cuts(const LoadMap& map, std::uint32_t column_parts, std::uint32_t row_parts) {
  return {even(map.columns, column_parts), even(map.rows, row_parts)};
}

double heaviest(const LoadMap& map, const RectilinearCuts& cuts) {
  const auto lines = lines_of(map, true, cuts.rows);
  double most = 0;
  Line sum(lines.front().size(), 0);
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    if (next < cuts.columns.size() && i == cuts.columns[next]) {
      ++next;
      std::fill(sum.begin(), sum.end(), 0);
    }
    for (std::size_t p = 0; p < sum.size(); ++p) most = std::max(most, sum[p] += lines[i][p]);
  }
  return most;
}

RectilinearCuts balanced_cuts(const LoadMap& map, std::uint32_t column_parts,
                              std::uint32_t row_parts) {
  RectilinearCuts cuts = even_cuts(map, column_parts, row_parts);
  RectilinearCuts best = cuts;
  double least = heaviest(map, cuts);
  for (int round = 0; round < kRounds; ++round) {
    cuts.columns = best_cuts(lines_of(map, true, cuts.rows), column_parts);
    cuts.rows = best_cuts(lines_of(map, false, cuts.columns), row_parts);
    const double now = heaviest(map, cuts);
    if (!(now < least)) break;
    least = now;
    best = cuts;
  }
  return best;
}

}  // namespace graycube
