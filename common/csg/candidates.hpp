// Which of many measured things may be as near to another as to be one: nearly none, mostly. What is left is worth sorting.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/clusters.hpp"

namespace graycube::csg {

/// To be told all values first, and asked about each afterwards. Takes 4 to 8 bytes for each.
class Candidates {
 public:
  /// Of about `count` values, whose tolerances are `tolerance` on average.
  Candidates(double tolerance, std::size_t count) {
    while ((std::size_t{1} << bits_) < kBucketsEach * count) ++bits_;
    once_.assign((std::size_t{1} << bits_) / 64, 0);
    twice_.assign(once_.size(), 0);
    const double step = kStepTolerances * tolerance;
    scale_ = step > 0 && std::isfinite(1 / step) ? 1 / step : 0;
  }

  void mark(const Measured& m) {
    if (!is_number(m)) return;
    const std::int64_t first = step_of(m.value - m.tolerance), last = step_of(m.value + m.tolerance);
    if (last - first >= kMostSteps) {
      if (wide_.size() < kMostWide) {
        wide_.push_back(m);
      } else {
        is_crowded_ = true;
      }
      return;
    }
    for (std::int64_t step = first; step <= last; ++step) {
      const std::size_t bucket = bucket_of(step);
      const std::uint64_t bit = std::uint64_t{1} << (bucket % 64);
      twice_[bucket / 64] |= once_[bucket / 64] & bit;
      once_[bucket / 64] |= bit;
    }
  }

  /// False only where no other's values come within its own and that one's tolerance.
  bool may_meet(const Measured& m) const {
    if (!is_number(m)) return false;
    if (is_crowded_) return true;
    for (const Measured& w : wide_) {
      if (std::fabs(m.value - w.value) <= m.tolerance + w.tolerance) return true;
    }
    const std::int64_t first = step_of(m.value - m.tolerance), last = step_of(m.value + m.tolerance);
    if (last - first >= kMostSteps) return true;
    for (std::int64_t step = first; step <= last; ++step) {
      const std::size_t bucket = bucket_of(step);
      if ((twice_[bucket / 64] >> (bucket % 64) & 1) != 0) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kBucketsEach = 16;
  static constexpr double kStepTolerances = 8;
  /// Values that may be in more steps are compared with all others, if there are few of them.
  static constexpr std::int64_t kMostSteps = 16;
  static constexpr std::size_t kMostWide = 32;

  static bool is_number(const Measured& m) { return std::isfinite(m.value) && m.tolerance >= 0 && std::isfinite(m.tolerance); }
  std::int64_t step_of(double v) const {
    // Steps on both sides of 0 are at most 2⁶² apart, which still is a number.
    constexpr double kFarthest = 0x1p+61;
    return static_cast<std::int64_t>(std::floor(std::min(std::max(v * scale_, -kFarthest), kFarthest)));
  }
  /// Fibonacci hashing (Knuth, volume 3, 6.4): steps side by side part.
  std::size_t bucket_of(std::int64_t step) const {
    return static_cast<std::size_t>(static_cast<std::uint64_t>(step) * 0x9E3779B97F4A7C15u >> (64 - bits_));
  }

  unsigned bits_ = 6;
  double scale_ = 0;
  bool is_crowded_ = false;
  std::vector<Measured> wide_;
  std::vector<std::uint64_t> once_, twice_;
};

}  // namespace graycube::csg
