// Finds where to cut a cell: the surface-area heuristic (MacDonald & Booth 1990) over the bounds of
// the surfaces in it.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/infinity.hpp"

namespace graycube {

/// A plane and its cost by the surface-area heuristic.
struct Split {
  int axis = -1;
  double at = 0;
  double cost = kInf;
};

/// Chooses a plane for a cell by sweeping over the ends of the surfaces' extents.
class SplitFinder {
 public:
  SplitFinder(const Aabb& cell, double gap, double step_cost)
      : cell_(cell), gap_(gap), step_cost_(step_cost) {}

  void add(const Aabb& surface) {
    const Aabb b = intersection_of(surface, cell_);
    if (b.is_empty()) return;
    for (int a = 0; a < 3; ++a) {
      lower_[static_cast<std::size_t>(a)].push_back(b.lo[a]);
      upper_[static_cast<std::size_t>(a)].push_back(b.hi[a]);
    }
  }
  std::size_t count() const { return lower_[0].size(); }

  Split best() {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (count() <= kExactLimit) {
        sweep_exact(axis, best);
      } else {
        sweep_bins(axis, best);
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t kExactLimit = 256;
  static constexpr int kBins = 64;

  /// Makes the plane `best` if it costs less, given the numbers of surfaces below and above it.
  void offer(int axis, double at, std::size_t below, std::size_t above, Split& best) const {
    if (!(at > cell_.lo[axis] + gap_ && at < cell_.hi[axis] - gap_)) return;
    Aabb lower = cell_;
    lower.hi[axis] = at;
    Aabb upper = cell_;
    upper.lo[axis] = at;
    const double area = cell_.half_area();
    double cost = (lower.half_area() * static_cast<double>(below) +
                   upper.half_area() * static_cast<double>(above)) /
                  area;
    // A plane that cuts empty space off costs less: nothing is tested there.
    if (below == 0 || above == 0) cost *= kEmptyDiscount;
    cost += step_cost_;
    if (cost < best.cost) best = {axis, at, cost};
  }
  static constexpr double kEmptyDiscount = 0.8;

  void sweep_exact(int axis, Split& best) {
    auto& lo = lower_[static_cast<std::size_t>(axis)];
    auto& hi = upper_[static_cast<std::size_t>(axis)];
    std::sort(lo.begin(), lo.end());
    std::sort(hi.begin(), hi.end());
    const std::size_t n = lo.size();
    // Planes just below a lower end and just above an upper end, so that neither touches the other
    // side.
    std::size_t ended = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = lo[i] - 2 * gap_;
      while (ended < n && hi[ended] < at) ++ended;
      offer(axis, at, i, n - ended, best);
    }
    std::size_t begun = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = hi[i] + 2 * gap_;
      while (begun < n && lo[begun] <= at) ++begun;
      offer(axis, at, begun, n - i - 1, best);
    }
  }

  void sweep_bins(int axis, Split& best) {
    const auto& lo = lower_[static_cast<std::size_t>(axis)];
    const auto& hi = upper_[static_cast<std::size_t>(axis)];
    const double first = *std::min_element(lo.begin(), lo.end());
    const double last = *std::max_element(hi.begin(), hi.end());
    offer(axis, first - 2 * gap_, 0, lo.size(), best);
    offer(axis, last + 2 * gap_, lo.size(), 0, best);
    if (!(last - first > 4 * gap_)) return;
    const double scale = kBins / (last - first);
    std::array<std::size_t, kBins + 1> begins{}, ends{};
    const auto bin = [&](double v) {
      const double at = (v - first) * scale;
      // Written so that NaN, which ends at infinity give, stays within the bins.
      return at > 0 ? static_cast<std::size_t>(std::min(at, kBins - 1.0)) : std::size_t{0};
    };
    for (const double v : lo) ++begins[bin(v)];
    for (const double v : hi) ++ends[bin(v)];
    std::size_t begun = 0;
    std::size_t ended = 0;
    for (int i = 1; i < kBins; ++i) {
      begun += begins[static_cast<std::size_t>(i - 1)];
      ended += ends[static_cast<std::size_t>(i - 1)];
      offer(axis, first + i / scale, begun, lo.size() - ended, best);
    }
  }

  Aabb cell_;
  double gap_, step_cost_;
  std::array<std::vector<double>, 3> lower_, upper_;
};

}  // namespace graycube
