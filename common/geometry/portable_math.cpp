#include "geometry/portable_math.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "check.hpp"
#include "geometry/infinity.hpp"

namespace graycube {
namespace {

constexpr double kSmallestNormal = std::numeric_limits<double>::min();

/// An unevaluated sum; `low` is at most about half a unit in the last place of `high`.
struct Double2 {
  double high = 0, low = 0;
};

/// a + b exactly, for |a| ≥ |b| or a = 0 (Dekker 1971).
Double2 fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// The upper 26 bits of a, so that products of halves are exact (Veltkamp). |a| below 2^970.
double upper_half(double a) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  return c - (c - a);
}

/// a · b exactly (Dekker 1971); a fused multiply-add would be quicker, but not on every machine.
Double2 two_product(double a, double b) {
  const double product = a * b;
  const double ah = upper_half(a), al = a - ah;
  const double bh = upper_half(b), bl = b - bh;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}

/// Σ coefficients[i] · x^i by Horner's rule.
template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double sum = coefficients[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

/// 2^exponent for −1022 ≤ exponent ≤ 1023.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// ---- Sine and cosine

struct SineCosine {
  double sine = 0, cosine = 0;
};

/// Sine and cosine for |degrees| ≤ 45, by Taylor series; the first term left out is below 1e-19.
SineCosine of_small_angle(double degrees) {
  if (std::fabs(degrees) == 45) {
    // One value for both, so that the tangent of 45° is exactly 1.
    const double half_root = std::sqrt(0.5);
    return {degrees < 0 ? -half_root : half_root, half_root};
  }
  constexpr Double2 kRadiansPerDegree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
  static constexpr std::array kSine{-1.0 / 6,
                                    1.0 / 120,
                                    -1.0 / 5040,
                                    1.0 / 362880,
                                    -1.0 / 39916800,
                                    1.0 / 6227020800.0,
                                    -1.0 / 1307674368000.0,
                                    1.0 / 355687428096000.0};
  static constexpr std::array kCosine{1.0 / 24,
                                      -1.0 / 720,
                                      1.0 / 40320,
                                      -1.0 / 3628800,
                                      1.0 / 479001600,
                                      -1.0 / 87178291200.0,
                                      1.0 / 20922789888000.0,
                                      -1.0 / 6402373705728000.0};
  const Double2 product = two_product(degrees, kRadiansPerDegree.high);
  const double x = product.high;
  const double rest = product.low + degrees * kRadiansPerDegree.low;  // the angle is x + rest
  const double xx = x * x;
  // sin(x + rest) = sin x + rest · cos x, cos(x + rest) = cos x − rest · x, to second order.
  const double sine = x + (x * xx * polynomial(kSine, xx) + rest * (1 - 0.5 * xx));
  const double half = 0.5 * xx, main = 1 - half;
  const double cosine =
      main + (((1 - main) - half) + (xx * xx * polynomial(kCosine, xx) - rest * x));
  return {sine, cosine};
}

SineCosine sine_cosine(double degrees) {
  // fmod is exact by definition, and the multiple of 90 taken away leaves no rounding either.
  const double in_turn = std::fmod(degrees, 360.0);
  if (!std::isfinite(in_turn)) return {in_turn, in_turn};
  const double quarters = std::floor(in_turn / 90 + 0.5);
  const SineCosine r = of_small_angle(in_turn - 90 * quarters);
  // Adding +0 turns −0 into +0.
  switch (static_cast<int>(quarters) & 3) {
    case 0: return {r.sine + 0.0, r.cosine + 0.0};
    case 1: return {r.cosine + 0.0, -r.sine + 0.0};
    case 2: return {-r.sine + 0.0, -r.cosine + 0.0};
    default: return {-r.cosine + 0.0, r.sine + 0.0};
  }
}

// ---- Powers

/// Up to this exponent repeated squaring is quicker and precise enough: its relative error is at
/// most n · 2^-53, 3e-14 at 256.
constexpr double kLargestSquaredExponent = 256;

double power_by_squaring(double base, std::uint32_t exponent) {
  double result = (exponent & 1) != 0 ? base : 1.0;
  for (exponent >>= 1; exponent != 0; exponent >>= 1) {
    base *= base;
    if ((exponent & 1) != 0) result *= base;
  }
  return result;
}

/// log2 of a finite x > 0, to about 2^-57 relative, also next to 1.
Double2 log2_of(double x) {
  int exponent = 0;
  if (x < kSmallestNormal) {
    x *= 18014398509481984.0;  // 2^54
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3ff0000000000000u);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  // With m in [√½, √2]: ln m = 2 atanh s = 2 (s + s³/3 + s⁵/5 + …), s = (m − 1) / (m + 1), |s| <
  // 0.172. s is taken with its remainder; the terms from s³ on are below 1 % of s and need no more
  // than a double.
  static constexpr std::array kOdd{1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                                   1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23};
  const double f = m - 1;
  const Double2 denominator = fast_two_sum(2.0, f);
  const double s = f / denominator.high;
  const Double2 back = two_product(s, denominator.high);
  const double remainder = ((f - back.high) - back.low - s * denominator.low) / denominator.high;
  const double ss = s * s;
  const Double2 series = fast_two_sum(s, remainder + s * ss * polynomial(kOdd, ss));

  constexpr Double2 kTwoOverLn2{0x1.71547652b82fep+1, 0x1.777d0ffda0d24p-55};
  const Double2 product = two_product(series.high, kTwoOverLn2.high);
  const double low = product.low + (series.high * kTwoOverLn2.low + series.low * kTwoOverLn2.high);
  const Double2 sum = fast_two_sum(static_cast<double>(exponent), product.high);
  return fast_two_sum(sum.high, sum.low + low);
}

/// 2^(high + low), |high| ≤ 1100; results below the smallest normal number become 0.
double exp2_of(const Double2& x) {
  // e^y = Σ yⁱ / i!; with |y| ≤ ln 2 / 2 the first term left out is below 1e-19.
  static constexpr std::array kFactorials{1.0,
                                          1.0,
                                          1.0 / 2,
                                          1.0 / 6,
                                          1.0 / 24,
                                          1.0 / 120,
                                          1.0 / 720,
                                          1.0 / 5040,
                                          1.0 / 40320,
                                          1.0 / 362880,
                                          1.0 / 3628800,
                                          1.0 / 39916800,
                                          1.0 / 479001600,
                                          1.0 / 6227020800.0,
                                          1.0 / 87178291200.0};
  constexpr double kLn2 = 0x1.62e42fefa39efp-1;
  const double whole = std::floor(x.high + 0.5);
  const double mantissa =
      polynomial(kFactorials, ((x.high - whole) + x.low) * kLn2);  // [0.7, 1.42]
  const int exponent = static_cast<int>(whole);
  if (exponent < -1022) return 0;  // even 1.42 · 2^-1023 is not normal
  if (exponent > 1024) return kInf;
  const double result =
      exponent == 1024 ? 2 * mantissa * power_of_two(1023) : mantissa * power_of_two(exponent);
  return result < kSmallestNormal ? 0 : result;
}

// ---- Arc cosine

/// The terms of asin x = x + x³ Σ terms[i] · x^2i; up to |x| = ½ the first one left out is below
/// 1e-17 of the sum.
constexpr std::array<double, 24> arc_sine_terms() {
  std::array<double, 24> terms{};
  double share = 1;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const auto k = static_cast<double>(i + 1);
    share *= (2 * k - 1) / (2 * k);
    terms[i] = share / (2 * k + 1);
  }
  return terms;
}

/// For |x| ≤ ½.
double arc_sine(double x) {
  static constexpr std::array kTerms = arc_sine_terms();
  return x + x * x * x * polynomial(kTerms, x * x);
}

}  // namespace

double sin_degrees(double angle_degrees) { return sine_cosine(angle_degrees).sine; }
double cos_degrees(double angle_degrees) { return sine_cosine(angle_degrees).cosine; }

double tan_degrees(double angle_degrees) {
  const SineCosine r = sine_cosine(angle_degrees);
  return r.sine / r.cosine;
}

double portable_pow(double base, double exponent) {
  GRAYCUBE_CHECK(!(base < 0) && !(exponent < 0), "%g to the power of %g", base, exponent);
  if (exponent == 0 || base == 1) return 1;
  if (std::isnan(base) || std::isnan(exponent)) return base + exponent;
  if (exponent <= kLargestSquaredExponent && exponent == std::floor(exponent)) {
    const double result = power_by_squaring(base, static_cast<std::uint32_t>(exponent));
    return result < kSmallestNormal ? 0 : result;
  }
  if (base == 0) return 0;
  if (std::isinf(base)) return base;
  const Double2 log2 = log2_of(base);
  const double estimate = exponent * log2.high;
  if (estimate > 1100) return kInf;
  if (estimate < -1100) return 0;
  const Double2 product = two_product(exponent, log2.high);
  return exp2_of({product.high, product.low + exponent * log2.low});
}

double portable_exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 750) return kInf;
  if (x < -750) return 0;
  constexpr Double2 kLog2OfE{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
  const Double2 product = two_product(x, kLog2OfE.high);
  return exp2_of({product.high, product.low + x * kLog2OfE.low});
}

double portable_acos(double cosine) {
  constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiRest = 0x1.1a62633145c07p-54;
  if (std::isnan(cosine)) return cosine;
  if (std::fabs(cosine) <= 0.5) return kHalfPi - (arc_sine(cosine) - kHalfPiRest);
  // 2 asin √((1 − c) / 2); 1 − c is exact there.
  const double folded = 2 * arc_sine(std::sqrt(0.5 * std::fmax(0, 1 - std::fabs(cosine))));
  return cosine > 0 ? folded : 2 * kHalfPi - (folded - 2 * kHalfPiRest);
}

}  // namespace graycube
