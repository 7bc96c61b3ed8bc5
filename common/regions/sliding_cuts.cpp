#include "regions/sliding_cuts.hpp"

#include <algorithm>

#include "check.hpp"

namespace graycube {
namespace {

using Cuts = std::vector<std::uint32_t>;

/// The first cell of a part, or the end of the last.
std::uint32_t begin_of(const Cuts& cuts, std::size_t part, std::uint32_t cells) {
  if (part == 0) return 0;
  return part <= cuts.size() ? cuts[part - 1] : cells;
}

/// The cuts of one direction, while those of the other stay.
class Direction {
 public:
  Direction(const WorkLeft& left, bool is_by_column, const Cuts& others)
      : left_(left),
        is_by_column_(is_by_column),
        cells_(is_by_column ? left.cells.columns : left.cells.rows),
        across_(others.size() + 1),
        before_((cells_ + std::size_t{1}) * across_, 0) {
    const std::uint32_t breadth = is_by_column ? left.cells.rows : left.cells.columns;
    for (std::uint32_t i = 0; i < cells_; ++i) {
      for (std::size_t other = 0; other < across_; ++other) {
        double sum = before_[i * across_ + other];
        const std::uint32_t end = begin_of(others, other + 1, breadth);
        for (std::uint32_t j = begin_of(others, other, breadth); j < end; ++j)
          sum += is_by_column ? left.cells.at(i, j) : left.cells.at(j, i);
        before_[(i + std::size_t{1}) * across_ + other] = sum;
      }
    }
  }

  std::uint32_t cells() const { return cells_; }

  /// The load of the heaviest part in a strip of parts, which has the cells `begin` to `end`.
  double heaviest(std::size_t strip, std::uint32_t begin, std::uint32_t end) const {
    double most = 0;
    for (std::size_t other = 0; other < across_; ++other) {
      const auto s = static_cast<std::uint32_t>(strip), o = static_cast<std::uint32_t>(other);
      const double stays = is_by_column_ ? left_.parts.at(s, o) : left_.parts.at(o, s);
      const double moves = before_[end * across_ + other] - before_[begin * across_ + other];
      most = std::max(most, stays + moves);
    }
    return most;
  }

 private:
  const WorkLeft& left_;
  bool is_by_column_;
  std::uint32_t cells_;
  std::size_t across_;
  /// For each cell and each part across, the load of the cells before it: cells first.
  std::vector<double> before_;
};

/// The place to which the cut between strips `i` and `i` + 1 slides.
std::uint32_t slid(const Direction& along, const Cuts& cuts, std::size_t i,
                   const SlideRules& rules) {
  const std::uint32_t begin = begin_of(cuts, i, along.cells()), cut = cuts[i],
                      end = begin_of(cuts, i + 2, along.cells());
  const auto heavier = [&](std::uint32_t at) {
    return std::max(along.heaviest(i, begin, at), along.heaviest(i + 1, at, end));
  };
  const double before = along.heaviest(i, begin, cut), after = along.heaviest(i + 1, cut, end);
  if (std::max(before, after) <= rules.least_ratio * std::min(before, after)) return cut;
  const std::uint32_t narrower = std::min(cut - begin, end - cut);
  const auto most =
      std::max(1u, static_cast<std::uint32_t>(rules.most_part * static_cast<double>(narrower)));
  const bool is_back = before > after;
  std::uint32_t best = cut;
  double lightest = heavier(cut);
  for (std::uint32_t step = 1; step <= most; ++step) {
    if (is_back ? cut - step <= begin : cut + step >= end) break;
    const std::uint32_t at = is_back ? cut - step : cut + step;
    const double heaviest = heavier(at);
    if (heaviest >= lightest) continue;
    best = at;
    lightest = heaviest;
  }
  return best;
}

void slide(const WorkLeft& left, bool is_by_column, Cuts& cuts, const Cuts& others,
           const SlideRules& rules) {
  const Direction along(left, is_by_column, others);
  for (std::size_t i = 0; i < cuts.size(); ++i) cuts[i] = slid(along, cuts, i, rules);
}

}  // namespace

RectilinearCuts slid_cuts(const WorkLeft& left, const RectilinearCuts& now,
                          const SlideRules& rules) {
  GRAYCUBE_CHECK(
      left.parts.columns == now.columns.size() + 1 && left.parts.rows == now.rows.size() + 1,
      "%u × %u parts", left.parts.columns, left.parts.rows);
  RectilinearCuts cuts = now;
  slide(left, true, cuts.columns, cuts.rows, rules);
  slide(left, false, cuts.rows, cuts.columns, rules);
  return cuts;
}

}  // namespace graycube
