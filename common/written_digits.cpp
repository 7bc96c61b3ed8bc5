#include "written_digits.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace graycube {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether `value` is a 24-bit number rounded to that many digits.
bool is_single_precision(double value, std::uint32_t digits) {
  const auto single = static_cast<double>(static_cast<float>(value));
  if (!std::isfinite(single)) return false;
  char text[40];
  const auto [end, error] =
      std::to_chars(text, text + sizeof text, single, std::chars_format::scientific,
                    static_cast<int>(digits) - 1);
  double again = 0;
  std::from_chars(text, end, again);
  return again == value;
}

}  // namespace

std::uint32_t significant_digits(std::string_view number) {
  std::uint32_t digits = 0, zeros = 0;
  bool behind_point = false;
  for (const char c : number) {
    if (c == '.') {
      behind_point = true;
    } else if (c == 'e' || c == 'E') {
      break;
    } else if (is_digit(c) && (digits > 0 || c != '0')) {
      ++digits;
      zeros = c == '0' ? zeros + 1 : 0;
    }
  }
  return std::min(behind_point ? digits : digits - zeros, kMaxDigits);
}

double half_unit(double v, std::uint32_t digits) {
  if (v == 0) return 0;
  char text[40];
  const char* end = std::to_chars(text, text + sizeof text, v, std::chars_format::scientific,
                                  static_cast<int>(digits) - 1)
                        .ptr;
  const char* exponent = std::find(static_cast<const char*>(text), end, 'e') + 1;
  int power = 0;
  std::from_chars(exponent + (*exponent == '+' ? 1 : 0), end, power);
  text[0] = '5';
  text[1] = 'e';
  end = std::to_chars(text + 2, text + sizeof text, power - static_cast<int>(digits)).ptr;
  double half = 0;
  std::from_chars(text, end, half);
  return half;
}

void WrittenDigits::see(std::string_view number, double value) {
  if (number.size() <= most_) return;
  std::uint32_t digits = significant_digits(number);
  if (digits > kSinglePrecisionDigits && is_single_precision(value, digits))
    digits = kSinglePrecisionDigits;
  most_ = std::max(most_, digits);
}

}  // namespace graycube
