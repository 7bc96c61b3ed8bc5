#include "geometry/portable_math.hpp"
#include "geometry/infinity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "catch.hpp"

using namespace graycube;

// The references are the C library's functions in extended precision, where long double has it.

namespace {

constexpr double kSmallestNormal = std::numeric_limits<double>::min();
constexpr long double kPi = 3.14159265358979323846264338327950288L;

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 engine_;
};

struct Reference {
  long double sine, cosine;
};

Reference reference_of(double degrees) {
  int quarter = 0;
  const long double r = std::remquo(static_cast<long double>(degrees), 90.0L, &quarter) * kPi / 180;
  long double s = std::sin(r), c = std::cos(r);
  if ((quarter & 1) != 0) {
    std::swap(s, c);
    c = -c;
  }
  return (quarter & 2) != 0 ? Reference{-s, -c} : Reference{s, c};
}

/// How far `value` is from `exact`, in units of the exact value's last place.
long double ulps(double value, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  return std::fabs(value - exact) / (std::nextafter(size, kInf) - size);
}

long double relative_error(double value, long double exact) {
  return std::fabs((value - exact) / exact);
}

/// The largest relative error of portable_pow over `count` draws of (base, exponent) whose exact
/// result is a normal number; fails when hardly any is.
template <typename Draw>
long double worst_error_of_pow(int count, Draw draw) {
  long double worst = 0;
  int normal = 0;
  for (int i = 0; i < count; ++i) {
    const auto [base, exponent] = draw();
    const long double exact =
        std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    if (exact < 1.0001L * kSmallestNormal || exact > 0.9999L * std::numeric_limits<double>::max())
      continue;
    ++normal;
    worst = std::max(worst, relative_error(portable_pow(base, exponent), exact));
  }
  CHECK(normal > count / 4);
  return worst;
}

}  // namespace

TEST_CASE("sine and cosine are within 4 ulp up to a million degrees") {
  RandomNumbers random(1);
  long double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double limit = i % 3 == 0 ? 1e6 : i % 3 == 1 ? 360 : 1e-3;
    const double angle = random.between(-limit, limit);
    const Reference exact = reference_of(angle);
    worst = std::max(
        {worst, ulps(sin_degrees(angle), exact.sine), ulps(cos_degrees(angle), exact.cosine)});
  }
  CHECK(worst < 4);
  CHECK(worst > 0);
}

TEST_CASE("multiples of 90 degrees are exact and never give a negative zero") {
  const double sine[] = {0, 1, 0, -1};
  for (int k = -4000; k <= 4000; ++k) {
    const double s = sin_degrees(90.0 * k), c = cos_degrees(90.0 * k);
    CHECK(std::bit_cast<std::uint64_t>(s) == std::bit_cast<std::uint64_t>(sine[k & 3]));
    CHECK(std::bit_cast<std::uint64_t>(c) == std::bit_cast<std::uint64_t>(sine[(k + 1) & 3]));
  }
}

TEST_CASE("well-known angles give their well-known values") {
  CHECK(sin_degrees(30) == 0.5);
  CHECK(cos_degrees(60) == 0.5);
  CHECK(tan_degrees(45) == 1);
  CHECK(tan_degrees(-45) == -1);
  CHECK(tan_degrees(135) == -1);
  CHECK(sin_degrees(45) == std::sqrt(0.5));
  CHECK(tan_degrees(20) == Approx(0.36397023426620234).epsilon(1e-15));
  CHECK(std::isinf(tan_degrees(90)));
  CHECK(std::isnan(sin_degrees(kInf)));
  CHECK(std::isnan(cos_degrees(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("sine rises from -90 to 90 degrees, also across the joints of its pieces") {
  for (const double start : {-90.0, -60.0, -45.0, 0.0, 30.0, 45.0, 89.0}) {
    double before = sin_degrees(start);
    for (int i = 1; i <= 1000; ++i) {
      const double now = sin_degrees(start + i * 1e-3);
      REQUIRE(now > before);
      before = now;
    }
  }
}

TEST_CASE("powers are within 1e-13 for shininesses of every size") {
  RandomNumbers random(2);
  SECTION("whole exponents") {
    CHECK(worst_error_of_pow(100000, [&] {
            return std::pair{random.between(0.5, 1), std::floor(random.between(0, 600))};
          }) < 1e-13L);
  }
  SECTION("any exponents") {
    CHECK(worst_error_of_pow(100000, [&] {
            const double exponent = std::exp(random.between(-5, 9.3));
            return std::pair{std::exp2(random.between(-1000, 1000) / exponent), exponent};
          }) < 1e-13L);
  }
  SECTION("bases next to 1, with exponents up to ten billion") {
    CHECK(worst_error_of_pow(100000, [&] {
            const double away = std::exp(random.between(-34, -2));
            return std::pair{random.between(0, 1) < 0.5 ? 1 - away : 1 + away,
                             std::exp(random.between(0, 23))};
          }) < 1e-13L);
  }
  SECTION("subnormal bases") {
    CHECK(worst_error_of_pow(20000, [&] {
            return std::pair{random.between(1, 1e6) * std::numeric_limits<double>::denorm_min(),
                             random.between(0.01, 0.9)};
          }) < 1e-13L);
  }
}

TEST_CASE("powers of two are exact") {
  for (int k = -1000; k <= 1000; k += 8) {
    CHECK(portable_pow(std::ldexp(1.0, k), 0.5) == Approx(std::ldexp(1.0, k / 2)).epsilon(1e-15));
    CHECK(portable_pow(std::ldexp(1.0, k / 8), 8) == std::ldexp(1.0, k / 8 * 8));
  }
}

TEST_CASE("powers at the ends of their range are 0, 1 or infinite") {
  CHECK(portable_pow(0, 0) == 1);
  CHECK(portable_pow(0.3, 0) == 1);
  CHECK(portable_pow(kInf, 0) == 1);
  CHECK(portable_pow(1, kInf) == 1);
  CHECK(portable_pow(1, 1e300) == 1);
  CHECK(portable_pow(0, 3) == 0);
  CHECK(portable_pow(0, 0.25) == 0);
  CHECK(portable_pow(0, 1e300) == 0);
  CHECK(portable_pow(0.5, kInf) == 0);
  CHECK(portable_pow(0.5, 1e300) == 0);
  CHECK(portable_pow(1.5, kInf) == kInf);
  CHECK(portable_pow(2, 1024) == kInf);
  CHECK(portable_pow(2, 1023.5) == Approx(std::pow(2.0, 1023.5)).epsilon(1e-13));
  CHECK(portable_pow(kInf, 0.5) == kInf);
  CHECK(portable_pow(0.7, 1) == 0.7);
  CHECK(std::isnan(portable_pow(std::numeric_limits<double>::quiet_NaN(), 2)));
  CHECK(std::isnan(portable_pow(0.5, std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("powers below the smallest normal number are 0 by either way of computing") {
  CHECK(portable_pow(0.5, 1022) == kSmallestNormal);
  CHECK(portable_pow(0.5, 1023) == 0);
  CHECK(portable_pow(0x1p-511, 2) == kSmallestNormal);
  CHECK(portable_pow(0x1p-512, 2) == 0);
  CHECK(portable_pow(0x1p-1022, 1) == kSmallestNormal);
  CHECK(portable_pow(0x1p-1030, 1) == 0);
  RandomNumbers random(3);
  for (int i = 0; i < 20000; ++i) {
    const double result = portable_pow(random.between(0.4, 0.6), random.between(900, 1200));
    REQUIRE((result == 0 || result >= kSmallestNormal));
  }
}

TEST_CASE("a power does not fall while its base rises") {
  for (const double exponent : {0.4, 1.0, 2.0, 5.5, 40.0, 200.5, 5000.0}) {
    CAPTURE(exponent);
    double before = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double now = portable_pow(i / 4000.0, exponent);
      REQUIRE(now >= before);
      before = now;
    }
    CHECK(before == 1);
  }
}

TEST_CASE("powers of e are within 1e-15 wherever they are normal numbers") {
  RandomNumbers random(11);
  long double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x = i % 2 == 0 ? random.between(-708, 709) : random.between(-2, 2);
    worst = std::max(worst, relative_error(portable_exp(x), std::exp(static_cast<long double>(x))));
  }
  CHECK(worst < 1e-15L);
  CHECK(portable_exp(0) == 1);
  CHECK(portable_exp(1) == 0x1.5bf0a8b145769p+1);
  CHECK(portable_exp(-1e-300) == 1);
  CHECK(portable_exp(-708.5) == 0);
  for (const double x : {-750.5, -1e300, -kInf}) CHECK(portable_exp(x) == 0);
  for (const double x : {710.0, 750.5, 1e300, kInf}) CHECK(portable_exp(x) == kInf);
  CHECK(std::isnan(portable_exp(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("arc cosines are within 4 ulp, and nothing is beyond the ends") {
  RandomNumbers random(12);
  long double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    double cosine = random.between(-1, 1);
    if (i % 4 == 0) cosine = 1 - std::ldexp(random.between(0.5, 1), -(i / 4 % 50));
    worst =
        std::max(worst, ulps(portable_acos(cosine), std::acos(static_cast<long double>(cosine))));
  }
  CHECK(worst < 4);
  CHECK(portable_acos(0) == static_cast<double>(kPi / 2));
  CHECK(portable_acos(0.5) == Approx(static_cast<double>(kPi / 3)).epsilon(1e-15));
  for (const double beyond : {1.0, 1.0000001, kInf}) {
    CHECK(portable_acos(beyond) == 0);
    CHECK(portable_acos(-beyond) == static_cast<double>(kPi));
  }
  CHECK(std::isnan(portable_acos(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("known bits of sines, powers and arc cosines are the same on every machine") {
  // Values of this implementation, recorded: another machine, compiler or option must not change a
  // bit.
  CHECK(std::bit_cast<std::uint64_t>(sin_degrees(20)) == 0x3fd5e3a8748a0bf5u);
  CHECK(std::bit_cast<std::uint64_t>(cos_degrees(123.456)) == 0xbfe1a43870d371f9u);
  CHECK(std::bit_cast<std::uint64_t>(portable_pow(0.97, 40)) == 0x3fd2ecf33ad9e56bu);
  CHECK(std::bit_cast<std::uint64_t>(portable_pow(0.97, 40.5)) == 0x3fd2a3b8f42a453au);
  CHECK(std::bit_cast<std::uint64_t>(portable_pow(0.9993, 5000)) == 0x3f9ee25dfb6db647u);
  CHECK(std::bit_cast<std::uint64_t>(portable_exp(-0.7)) == 0x3fdfc80db9dd5542u);
  CHECK(std::bit_cast<std::uint64_t>(portable_acos(0.3)) == 0x3ff441f5ecbeef59u);
  CHECK(std::bit_cast<std::uint64_t>(portable_acos(0.97)) == 0x3fcf6eb0dd607284u);
}
