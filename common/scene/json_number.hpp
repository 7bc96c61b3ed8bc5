// The value of a JSON number's text: the nearest double, quickly where the number is short.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace graycube {

/// Gathers a number's digits while its grammar is checked.
class JsonDecimal {
 public:
  /// Takes the digits that stand in `text` from position `at` on; returns the position after them.
  std::size_t take(std::string_view text, std::size_t at) {
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at) {
      if (digits_ > 0 || text[at] != '0') ++digits_;
      if (digits_ <= kExactDigits)
        mantissa_ = mantissa_ * 10 + static_cast<std::uint64_t>(text[at] - '0');
    }
    return at;
  }
  /// So many of the digits taken stand after the point.
  void end_fraction(std::size_t count) { fraction_digits_ = count; }
  void expect_exponent() { has_exponent_ = true; }

  /// `number` is the whole text, whose grammar is right. Beyond a double's range: infinity or zero.
  double value(std::string_view number) const;

 private:
  static constexpr std::uint64_t kExactDigits = 18;

  std::uint64_t mantissa_ = 0;  // of the first kExactDigits digits
  std::uint64_t digits_ = 0;    // significant ones: leading zeros are not counted
  std::size_t fraction_digits_ = 0;
  bool has_exponent_ = false;
};

}  // namespace graycube
