#include "simulation/cost_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graycube::simulation {
namespace {

/// Rounds of coordinate descent; the costs settle long before.
constexpr int kRounds = 2000;

/// Units that are measured together: evaluators, building, nodes' brains, the frontal's.
constexpr std::array<std::size_t, kUnits> kGroupOf{0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 3, 3, 4, 4, 4};

std::size_t group_of(const PerUnit& counts) {
  for (std::size_t i = 0; i < kUnits; ++i) {
    if (counts.value[i] > 0) return kGroupOf[i];
  }
  return kUnits;
}

}  // namespace

void CostFit::add(const PerUnit& counts, double seconds) {
  const std::size_t group = group_of(counts);
  if (group >= kGroups) return;
  const double own_s = std::max(0.0, seconds - overhead_s_);
  ++measurements_;
  counts_.add(counts);
  seconds_[group] += own_s;
  for (std::size_t i = 0; i < kUnits; ++i) {
    if (counts.value[i] == 0) continue;
    moments_[i] += counts.value[i] * own_s;
    for (std::size_t j = 0; j < kUnits; ++j) products_[i][j] += counts.value[i] * counts.value[j];
  }
}

double CostFit::seconds() const { return std::accumulate(seconds_.begin(), seconds_.end(), 0.0); }

PerUnit CostFit::costs() const {
  PerUnit costs;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < kUnits; ++i) {
      if (products_[i][i] <= 0) continue;
      double rest = moments_[i];
      for (std::size_t j = 0; j < kUnits; ++j) {
        if (j != i) rest -= products_[i][j] * costs.value[j];
      }
      costs.value[i] = std::max(0.0, rest / products_[i][i]);
    }
  }
  for (std::size_t group = 0; group < kGroups; ++group) {
    double sum = 0;
    for (std::size_t i = 0; i < kUnits; ++i) {
      if (kGroupOf[i] == group) sum += counts_.value[i] * costs.value[i];
    }
    if (sum <= 0) continue;
    for (std::size_t i = 0; i < kUnits; ++i) {
      if (kGroupOf[i] == group) costs.value[i] *= seconds_[group] / sum;
    }
  }
  return costs;
}

}  // namespace graycube::simulation
