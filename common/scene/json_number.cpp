#include "scene/json_number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace graycube {
namespace {

/// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                              1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                              1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// from_chars says "out of range" for both ends; the decimal exponent of the first digit tells
/// which.
double out_of_range_value(std::string_view number) {
  const bool negative = number.front() == '-';
  const std::size_t e = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, e);
  const std::size_t first = digits.find_first_of("123456789");
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const bool before_point = first != std::string_view::npos && first < point;
  double exponent =
      before_point ? static_cast<double>(point - first) : -static_cast<double>(first - point);
  if (e != std::string_view::npos) {
    double written = 0;
    for (const char c : number.substr(e + 1))
      if (c >= '0' && c <= '9') written = std::fmin(written * 10 + (c - '0'), 1e12);
    exponent += number[e + 1] == '-' ? -written : written;
  }
  const double magnitude = exponent > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -magnitude : magnitude;
}

}  // namespace

double JsonDecimal::value(std::string_view number) const {
  // One correctly rounded division of two exact doubles gives the nearest double (Clinger 1990).
  constexpr std::uint64_t kLargestExact = 1ull << 53;
  if (!has_exponent_ && digits_ <= kExactDigits && mantissa_ <= kLargestExact &&
      fraction_digits_ < kPowersOfTen.size()) {
    const double magnitude = static_cast<double>(mantissa_) / kPowersOfTen[fraction_digits_];
    return number.front() == '-' ? -magnitude : magnitude;
  }
  double result = 0;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), result);
  return read.ec == std::errc{} ? result : out_of_range_value(number);
}

}  // namespace graycube
