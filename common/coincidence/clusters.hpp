// Finds which of many things may be the same, by several numbers of each, with tolerances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "stop_point.hpp"
#include "stoppable_sort.hpp"

namespace graycube::csg {

/// A number that may be off by its tolerance.
struct Measured {
  double value = 0, tolerance = 0;
};

/// A measured thing as an interval of values.
struct Extent {
  double lo, hi;
  std::uint32_t item;
};

/// Cuts extents that overlap like the links of a chain, but have no point in common, into runs that
/// have one: the nearest extents are joined first, as long as they have a common point.
class ChainCutter {
 public:
  explicit ChainCutter(std::span<Extent> chain);
  /// The runs, in order. Neither the given order nor the items' numbers affect which extents make a
  /// run.
  std::vector<std::span<Extent>> runs() const { return runs_; }

 private:
  /// The extents from `first` to before `end`, and the interval that they have in common if is_run.
  struct Piece {
    std::size_t first, end;
    double most_lo, least_hi;
    bool is_run;
  };
  void join(std::size_t gap);
  void keep(const Piece& piece);

  std::span<Extent> chain_;
  std::vector<Piece> pieces_;
  /// For each extent that is the first or last of a piece, that piece; meaningless for all others.
  std::vector<std::size_t> piece_of_;
  std::vector<std::span<Extent>> runs_;
};

/// Sorts the extents and calls visit(run) for each run of them that has a point in common. Things
/// that are the same share their true value, so they are in one run, if nothing else is as near;
/// and runs don't grow by chaining: all of a run are within tolerance of each other. Neither the
/// given order nor the items' numbers affect which extents make a run.
template <typename Visit>
void for_each_run(std::span<Extent> extents, Visit&& visit) {
  const auto end_of_numbers = std::partition(extents.begin(), extents.end(), [](const Extent& e) {
    return std::isfinite(e.lo) && std::isfinite(e.hi);
  });
  // Values that overflowed equal nothing.
  extents = extents.first(static_cast<std::size_t>(end_of_numbers - extents.begin()));
  stoppable_sort(extents, [](const Extent& a, const Extent& b) {
    return a.lo != b.lo ? a.lo < b.lo : a.hi != b.hi ? a.hi < b.hi : a.item < b.item;
  });
  for (std::size_t first = 0; first < extents.size();) {
    stop_if_asked();
    double reached = extents[first].hi, common = reached;
    std::size_t end = first + 1;
    for (; end < extents.size() && extents[end].lo <= reached; ++end) {
      reached = std::max(reached, extents[end].hi);
      common = std::min(common, extents[end].hi);
    }
    const std::span<Extent> chain = extents.subspan(first, end - first);
    first = end;
    if (chain.back().lo <= common) {
      visit(chain);
    } else {
      for (const std::span<Extent> run : ChainCutter(chain).runs()) visit(run);
    }
  }
}

/// Splits items by their numbers until those left together can't be told apart by any number.
template <typename Measure, typename Visit>
class Clusters {
 public:
  Clusters(int dimensions, const Measure& measure, const Visit& visit)
      : dimensions_(dimensions), measure_(measure), visit_(visit) {}

  void find(std::vector<Extent> items) { split(items, 0, 0, 0); }

 private:
  /// A split may make it worth comparing earlier numbers again; no ordinary scene needs more than
  /// two rounds.
  static constexpr int kMostRounds = 4;

  void split(std::span<Extent> items, int dimension, int agreeing, int passes) {
    if (items.size() < 2) return;
    if (items.size() == 2) {
      if (agree(items[0].item, items[1].item)) visit_(items);
      return;
    }
    if (agreeing == dimensions_ || passes == kMostRounds * dimensions_) return visit_(items);
    for (Extent& e : items) {
      stop_if_asked();
      const Measured m = measure_(e.item, dimension);
      e.lo = m.value - m.tolerance;
      e.hi = m.value + m.tolerance;
    }
    const int next = (dimension + 1) % dimensions_;
    for_each_run(items, [&](std::span<Extent> run) {
      split(run, next, run.size() == items.size() ? agreeing + 1 : 1, passes + 1);
    });
  }

  /// Compares just two items, which is the usual case, by each number once.
  bool agree(std::uint32_t a, std::uint32_t b) const {
    for (int i = 0; i < dimensions_; ++i) {
      const Measured x = measure_(a, i), y = measure_(b, i);
      if (!(std::fabs(x.value - y.value) <= x.tolerance + y.tolerance)) return false;
    }
    return true;
  }

  int dimensions_;
  const Measure& measure_;
  const Visit& visit_;
};

/// Calls visit(span of Extent) for each set of two or more of the items that may be the same:
/// measure(item, dimension) gives their numbers. O(n log n), as the number of rounds is bounded.
template <typename Measure, typename Visit>
void for_each_cluster(std::vector<Extent> items, int dimensions, const Measure& measure,
                      const Visit& visit) {
  Clusters<Measure, Visit>(dimensions, measure, visit).find(std::move(items));
}

}  // namespace graycube::csg
