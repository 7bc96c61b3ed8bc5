// Light in fixed point, 2^-32 per unit: integer addition commutes, so the order in which
// contributions arrive can't show in the picture. A contribution is rounded once, where it is made.
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/vec.hpp"

namespace graycube {

/// Sums of up to kMaxMergedContributions contributions, in units of 2^-32.
struct FixedRgb {
  std::int64_t r = 0, g = 0, b = 0;

  constexpr void add(const FixedRgb& o) {
    r += o.r;
    g += o.g;
    b += o.b;
  }
  friend constexpr bool operator==(const FixedRgb&, const FixedRgb&) = default;
};

inline constexpr double kFixedOne = 4294967296.0;  // 2^32
/// A contribution's largest component; brighter ones are clamped and counted.
inline constexpr double kMaxContribution = 1048576.0;  // 2^20
/// This many clamped contributions can't overflow 64 bits: 2^10 · 2^52 < 2^63.
inline constexpr std::uint32_t kMaxMergedContributions = 1024;
/// A merged contribution's largest component: the sum of the most and largest contributions, 2^62.
inline constexpr std::int64_t kMaxMergedLight =
    std::int64_t{kMaxMergedContributions} * static_cast<std::int64_t>(kMaxContribution * kFixedOne);

/// The numbers of components that were not finite, or were clamped, when they were rounded.
struct RoundingCounts {
  std::uint64_t non_finite = 0;
  std::uint64_t clamped = 0;

  void add(const RoundingCounts& o) {
    non_finite += o.non_finite;
    clamped += o.clamped;
  }
};

/// Rounds one component to nearest, halves up; NaN and infinities become 0, others are clamped to
/// [0, kMaxContribution].
inline std::int64_t to_fixed(double v, RoundingCounts& counts) {
  if (!std::isfinite(v)) [[unlikely]] {
    ++counts.non_finite;
    return 0;
  }
  if (v > kMaxContribution || v < 0) [[unlikely]] {
    ++counts.clamped;
    v = v < 0 ? 0 : kMaxContribution;
  }
  return static_cast<std::int64_t>(v * kFixedOne + 0.5);
}

inline FixedRgb to_fixed(const Rgb& light, RoundingCounts& counts) {
  return {to_fixed(light.r, counts), to_fixed(light.g, counts), to_fixed(light.b, counts)};
}

}  // namespace graycube
