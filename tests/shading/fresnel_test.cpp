// Fresnel's equations against the textbook's, in complex numbers.
#include "shading/fresnel.hpp"

#include <cmath>
#include <complex>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "shading/phong.hpp"

using namespace graycube;
using graycube::testing::Dice;

namespace {

/// Amplitudes of both polarisations, Born & Wolf's (1.5.20, 1.5.21), with a complex index.
double reference(double cosine, double n, double k) {
  using Complex = std::complex<double>;
  const Complex index{n, k}, square = index * index;
  const Complex beyond = std::sqrt(square - (1 - cosine * cosine));
  return (std::norm((cosine - beyond) / (cosine + beyond)) +
          std::norm((square * cosine - beyond) / (square * cosine + beyond))) /
         2;
}

}  // namespace

TEST_CASE("reflection at known angles is as in any table") {
  CHECK(fresnel(1, 1.5, 0) == Approx(0.04).epsilon(1e-14));
  CHECK(fresnel(1, 1 / 1.5, 0) == Approx(0.04).epsilon(1e-14));
  // At Brewster's angle only one polarisation is left: ((n² − 1) / (n² + 1))² of it.
  const double brewster = 1 / std::sqrt(1 + 1.5 * 1.5);
  CHECK(fresnel(brewster, 1.5, 0) == Approx(0.5 * std::pow(1.25 / 3.25, 2)).epsilon(1e-13));
  // Gold at 650 nm: ((n − 1)² + k²) / ((n + 1)² + k²).
  CHECK(fresnel(1, 0.14, 4.1) ==
        Approx((0.86 * 0.86 + 4.1 * 4.1) / (1.14 * 1.14 + 4.1 * 4.1)).epsilon(1e-13));
  for (const double k : {0.0, 3.0}) CHECK(fresnel(0, 2, k) == 1);
}

TEST_CASE("reflection follows the complex amplitudes, for glass and metal, from either side") {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const double cosine = dice.unit(), n = dice.between(0.05, 4);
    const double k = dice.one_in(2) ? 0 : dice.between(0, 8);
    const double f = fresnel(cosine, n, k);
    CHECK(f == Approx(reference(cosine, n, k)).margin(1e-9));
    CHECK(f >= 0);
    CHECK(f <= 1);
  }
}

TEST_CASE("reflection is 1 where no light goes through, and 0 where nothing changes") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const double ior = dice.between(1.01, 3), sine = dice.unit();
    const double cosine = std::sqrt(1 - sine * sine);
    const bool is_total = !refracted({sine, -cosine, 0}, {0, 1, 0}, ior);
    if (std::fabs(ior * sine - 1) > 1e-9) CHECK((fresnel(cosine, 1 / ior, 0) == 1) == is_total);
    CHECK(fresnel(cosine, 1, 0) == 0);
  }
}

TEST_CASE("reflection has a value at the ends of all ranges") {
  for (const double n : {kLeastIndex, 1.0, kMostIndex}) {
    for (const double k : {0.0, 1e-300, kMostIndex}) {
      for (const double cosine : {-1e-17, 0.0, 1e-300, 0.5, 1.0, 1 + 1e-15}) {
        const double f = fresnel(cosine, n, k);
        INFO(n << ' ' << k << ' ' << cosine << ": " << f);
        CHECK((f >= 0 && f <= 1));
      }
    }
  }
}

TEST_CASE("colours have their own indices, and glass is met from within by 1 / n, metal by n") {
  Material m;
  m.model = ShadingModel::kTorranceSparrow;
  m.optics.index = {0.14, 1.5, 2};
  m.optics.absorption = {4, 0, 0};
  const Rgb outside = fresnel(m, 0.7, false), within = fresnel(m, 0.7, true);
  CHECK(outside == Rgb{fresnel(0.7, 0.14, 4), fresnel(0.7, 1.5, 0), fresnel(0.7, 2, 0)});
  CHECK(within == Rgb{fresnel(0.7, 0.14, 4), fresnel(0.7, 1 / 1.5, 0), fresnel(0.7, 0.5, 0)});
}
