// Sums and products of counts that stop at the largest number instead of wrapping round.
#pragma once

#include <cstdint>
#include <limits>

namespace graycube {

/// Stands for every count that is too large for 64 bits.
inline constexpr std::uint64_t kCountless = std::numeric_limits<std::uint64_t>::max();

constexpr std::uint64_t saturating_sum(std::uint64_t a, std::uint64_t b) {
  return b > kCountless - a ? kCountless : a + b;
}
constexpr std::uint64_t saturating_product(std::uint64_t a, std::uint64_t b) {
  return a != 0 && b > kCountless / a ? kCountless : a * b;
}

}  // namespace graycube
