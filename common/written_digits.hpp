// Tells how exact the numbers of a text are from the digits with which they are written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace graycube {

/// Significant digits that a double may need to be told from its neighbours.
inline constexpr std::uint32_t kMaxDigits = 17;
/// Numbers with fewer digits than this are taken to be round, not rounded: 10 and 0.5 are exactly
/// that.
inline constexpr std::uint32_t kLeastWrittenDigits = 6;
/// Digits of numbers with 24 bits, whose relative rounding error is up to 2⁻²⁴ = 6 · 10⁻⁸: that of
/// seven digits is up to 5 · 10⁻⁸ to 5 · 10⁻⁷; eight digits don't cover it.
inline constexpr std::uint32_t kSinglePrecisionDigits = 7;

/// The significant digits of a decimal number as from_chars reads it, at most 17: from the first
/// that isn't 0 to the last; zeros at the end count behind a point only. 0 for anything without
/// digits.
std::uint32_t significant_digits(std::string_view number);

/// Half a unit in the last of that many significant digits, 1 to 17, of a finite number: the
/// largest error of rounding it to them. 0 for 0.
double half_unit(double v, std::uint32_t digits);

/// The number of digits of a text's numbers: that of the longest.
class WrittenDigits {
 public:
  /// Notes a number; `value` is that of `number`. If it could be a 24-bit number written with more
  /// digits than such numbers have, it counts as one of kSinglePrecisionDigits.
  void see(std::string_view number, double value);
  std::uint32_t most() const { return std::max(most_, kLeastWrittenDigits); }

 private:
  std::uint32_t most_ = 0;
};

}  // namespace graycube
