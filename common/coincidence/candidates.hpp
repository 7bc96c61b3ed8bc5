// Finds which of many measured things may be near enough to another to be the same: mostly hardly
// any. Those few are worth sorting.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coincidence/clusters.hpp"

namespace graycube::csg {

/// All values are marked first, then each can be asked about. Takes 4 to 8 bytes for each value.
class Candidates {
 public:
  /// For about `count` values, whose tolerances are `tolerance` on average.
  Candidates(double tolerance, std::size_t count) {
    while ((std::size_t{1} << bits_) < kBucketsEach * count) ++bits_;
    once_.assign((std::size_t{1} << bits_) / 64, 0);
    twice_.assign(once_.size(), 0);
    const double step = kStepTolerances * tolerance;
    if (!(step > 0) || !std::isfinite(1 / step)) return;
    scale_ = 1 / step;
    widest_ = 0.499 * step;
  }

  void mark(const Measured& m) {
    if (!is_number(m)) return;
    if (m.tolerance > widest_) {
      if (wide_.size() < kMostWide) {
        wide_.push_back(m);
      } else {
        is_crowded_ = true;
      }
      return;
    }
    for_each_step(m, [&](std::int64_t step) {
      const std::size_t bucket = bucket_of(step);
      const std::uint64_t bit = std::uint64_t{1} << (bucket % 64);
      twice_[bucket / 64] |= once_[bucket / 64] & bit;
      once_[bucket / 64] |= bit;
    });
  }

  /// False only if no other value is within the sum of both tolerances: values that are have a step
  /// in common.
  bool may_meet(const Measured& m) const {
    if (!is_number(m)) return false;
    if (is_crowded_ || m.tolerance > widest_) return true;
    bool is_shared = false;
    for_each_step(m, [&](std::int64_t step) {
      const std::size_t bucket = bucket_of(step);
      is_shared |= (twice_[bucket / 64] >> (bucket % 64) & 1) != 0;
    });
    if (is_shared || wide_.empty()) return is_shared;
    return std::any_of(wide_.begin(), wide_.end(), [&](const Measured& w) {
      return std::fabs(m.value - w.value) <= m.tolerance + w.tolerance;
    });
  }

 private:
  using Bits = std::vector<std::uint64_t>;
  static constexpr std::size_t kBucketsEach = 16;
  static constexpr double kStepTolerances = 32;
  /// Values known worse than half a step are compared with all others, if there are few of them.
  static constexpr std::size_t kMostWide = 32;

  static bool is_number(const Measured& m) {
    // Values that aren't finite make this NaN.
    return m.tolerance >= 0 && (m.value - m.value) + (m.tolerance - m.tolerance) == 0;
  }
  /// Calls visit(step) for the one or two steps that the value may lie in.
  template <typename Visit>
  void for_each_step(const Measured& m, const Visit& visit) const {
    constexpr double kFarthest = 0x1p+62;
    const double at = m.value * scale_;
    const double near = at < kFarthest ? (at > -kFarthest ? at : -kFarthest) : kFarthest;
    // The floor, without a library call.
    const auto whole = static_cast<std::int64_t>(near);
    const std::int64_t step = static_cast<double>(whole) > near ? whole - 1 : whole;
    visit(step);
    // Scaling rounds; allowing for it costs nothing, unless values are far larger than steps.
    constexpr double kRounding = 0x1p-50;
    const double within = near - static_cast<double>(step),
                 tolerance = m.tolerance * scale_ + kRounding * std::fabs(near);
    if (within <= tolerance) visit(step - 1);
    if (within >= 1 - tolerance) visit(step + 1);
  }
  /// Fibonacci hashing (Knuth, volume 3, 6.4), which scatters neighbouring steps.
  std::size_t bucket_of(std::int64_t step) const {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(step) * 0x9E3779B97F4A7C15u >>
                                    (64 - bits_));
  }

  unsigned bits_ = 6;
  double scale_ = 0;
  /// The largest tolerance that steps are made for: a little less than half a step.
  double widest_ = 0;
  bool is_crowded_ = false;
  std::vector<Measured> wide_;
  Bits once_, twice_;
};

}  // namespace graycube::csg
