#include "film/transfer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// The value clamped to [0, 1]; written so that NaN becomes 0.
double clamped(float v) { return v > 0 ? std::min(static_cast<double>(v), 1.0) : 0.0; }

int srgb_code(double v) {
  const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * portable_pow(v, 1 / 2.4) - 0.055;
  return static_cast<int>(255 * encoded + 0.5);
}

/// Entry k is the least float whose code is k + 1; the last one is beyond all.
using Thresholds = std::array<float, 256>;

/// Thresholds are used since a power for each sample would cost more than all else in writing a
/// PNG. Non-negative floats are ordered like their bits, so each is found by bisecting the bits.
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
  thresholds.back() = 2;
  return thresholds;
}

/// Codes of floats from 0 to 1 without a search: the upper half of the bits gives the code at the
/// beginning of an interval that few thresholds share.
class SrgbCodes {
 public:
  SrgbCodes() : thresholds_(find_thresholds()) {
    std::uint8_t code = 0;
    for (std::uint32_t i = 0; i < kIntervals; ++i) {
      const auto begin = std::bit_cast<float>(i << kBits);
      while (begin >= thresholds_[code]) ++code;
      first_code_[i] = code;
    }
  }

  std::uint8_t operator()(float v) const {
    std::uint8_t code = first_code_[std::bit_cast<std::uint32_t>(v) >> kBits];
    while (v >= thresholds_[code]) ++code;
    return code;
  }

 private:
  static constexpr int kBits = 16;
  static constexpr std::uint32_t kIntervals = (std::bit_cast<std::uint32_t>(1.0f) >> kBits) + 1;

  Thresholds thresholds_;
  std::array<std::uint8_t, kIntervals> first_code_{};
};

}  // namespace

std::uint16_t linear_16_bit(float v) {
  return static_cast<std::uint16_t>(static_cast<int>(65535 * clamped(v) + 0.5));
}

std::uint8_t srgb_8_bit(float v) {
  static const SrgbCodes codes;
  return codes(v > 0 ? std::min(v, 1.0f) : 0.0f);
}

}  // namespace graycube
