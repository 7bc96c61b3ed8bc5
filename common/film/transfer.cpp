#include "film/transfer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// Written so that NaN falls to 0.
double clamped(float v) { return v > 0 ? std::min(static_cast<double>(v), 1.0) : 0.0; }

int srgb_code(double v) {
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * portable_pow(v, 1 / 2.4) - 0.055;
  return static_cast<int>(255 * encoded + 0.5);
}

/// Entry k is the least float whose code is k + 1.
using Thresholds = std::array<float, 255>;

/// A power per sample would cost more than all else in writing a PNG. Non-negative floats are
/// ordered as their bits are, so each threshold is found by halving the range of bits.
Thresholds find_thresholds() {
  Thresholds thresholds{};
  std::uint32_t below = 0;  // its code is at most k
  for (int k = 0; k < 255; ++k) {
    auto reached = std::bit_cast<std::uint32_t>(1.0f);
    while (reached - below > 1) {
      const std::uint32_t middle = below + (reached - below) / 2;
      (srgb_code(std::bit_cast<float>(middle)) > k ? reached : below) = middle;
    }
    thresholds[static_cast<std::size_t>(k)] = std::bit_cast<float>(reached);
  }
  return thresholds;
}

}  // namespace

std::uint16_t linear_16_bit(float v) {
  return static_cast<std::uint16_t>(static_cast<int>(65535 * clamped(v) + 0.5));
}

std::uint8_t srgb_8_bit(float v) {
  static const Thresholds thresholds = find_thresholds();
  const auto position = std::upper_bound(thresholds.begin(), thresholds.end(), clamped(v));
  return static_cast<std::uint8_t>(position - thresholds.begin());
}

}  // namespace graycube
