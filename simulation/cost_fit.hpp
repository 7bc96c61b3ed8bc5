// Finds the cost of each unit of work from measurements of work made of many units.
#pragma once

#include <array>
#include <cstddef>

#include "simulation/doings.hpp"

namespace graycube::simulation {

/// Least squares over all measurements, each cost at least 0. Then the costs of evaluators,
/// building, nodes' brains and the frontal's are scaled, so that each group's measured sum is met.
class CostFit {
 public:
  /// `overhead_s`: seconds that measuring itself adds to each measurement.
  explicit CostFit(double overhead_s) : overhead_s_(overhead_s) {}

  void add(const PerUnit& counts, double seconds);
  std::size_t measurements() const { return measurements_; }
  /// CPU seconds for each unit; 0 for units that never occurred.
  PerUnit costs() const;

  /// The sum of all counts, and the sum of all measured seconds.
  const PerUnit& counts() const { return counts_; }
  double seconds() const;

 private:
  static constexpr std::size_t kGroups = 4;
  double overhead_s_;
  std::size_t measurements_ = 0;
  std::array<std::array<double, kUnits>, kUnits> products_{};
  std::array<double, kUnits> moments_{};
  PerUnit counts_;
  std::array<double, kGroups> seconds_{};
};

}  // namespace graycube::simulation
