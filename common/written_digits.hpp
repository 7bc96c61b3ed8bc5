// How exact the numbers of a text are, by how they are written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace graycube {

/// Significant digits that a double may need to be told from its neighbours.
inline constexpr std::uint32_t kMaxDigits = 17;
/// Numbers shorter than this are taken for round ones, not for rounded ones: 10 and 0.5 mean
/// themselves.
inline constexpr std::uint32_t kLeastWrittenDigits = 6;
/// Of numbers with 24 bits: seven digits are rounded by 5 · 10⁻⁸ to 5 · 10⁻⁷ of them, 24 bits by up
/// to 2⁻²⁴ = 6 · 10⁻⁸, which eight digits don't cover.
inline constexpr std::uint32_t kSinglePrecisionDigits = 7;

/// The significant digits of a decimal number as from_chars reads it, at most 17: from the first
/// that isn't 0 to the last; zeros at the end count behind a point only. 0 for anything without
/// digits.
std::uint32_t significant_digits(std::string_view number);

/// Half a unit in the last of so many significant digits, 1 to 17, of a finite number: what it is
/// off at most when it is rounded to them. 0 for 0.
double half_unit(double v, std::uint32_t digits);

/// The digits of a text's numbers: those of the longest.
class WrittenDigits {
 public:
  /// `value` is that of `number`. One that could be a number of 24 bits, written with more digits
  /// than that has, counts as one.
  void see(std::string_view number, double value);
  std::uint32_t most() const { return std::max(most_, kLeastWrittenDigits); }

 private:
  std::uint32_t most_ = 0;
};

}  // namespace graycube
