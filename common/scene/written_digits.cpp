#include "scene/written_digits.hpp"

#include <charconv>
#include <cmath>

#include "scene/read_scene.hpp"

namespace graycube {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether a 24-bit number, written with so many digits, is `value`.
bool is_single_precision(double value, std::uint32_t digits) {
  const auto single = static_cast<double>(static_cast<float>(value));
  if (!std::isfinite(single)) return false;
  char text[40];
  const auto [end, error] =
      std::to_chars(text, text + sizeof text, single, std::chars_format::scientific, static_cast<int>(digits) - 1);
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

void WrittenDigits::see(std::string_view number, double value) {
  if (number.size() <= most_) return;
  std::uint32_t digits = significant_digits(number);
  if (digits > kSinglePrecisionDigits && is_single_precision(value, digits)) digits = kSinglePrecisionDigits;
  most_ = std::max(most_, digits);
}

}  // namespace graycube
