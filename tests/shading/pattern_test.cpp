// Colours that change with the place.
#include "shading/pattern.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "shading/lattice_noise.hpp"

using namespace graycube;
using graycube::testing::Dice;

TEST_CASE("noise has the very numbers that BRL-CAD's libbn gives") {
  // Computed by libbn's noise.c and rand.c on their own.
  struct {
    Vec3 p;
    double noise, sum, turbulence, other_sum;
  } const cases[] = {
      {{0.5, 0.25, 0.75},
       -0.41486439269920083,
       -0.34406089127833733,
       0.51505435947327771,
       -0.55569377179094259},
      {{1000.3, 1001.7, 1002.9},
       -0.18529067156954623,
       -0.3850870175009885,
       0.42766285149859418,
       -0.2423707298663359},
      {{-3.3, 4095.6, 12345.678},
       -0.5775988093441955,
       -0.96189852280107746,
       0.96189852280107746,
       -0.53070056913240604},
      {{17.01, 0, 3},
       -0.44079582655780369,
       -0.34659622106100635,
       0.56488077102633816,
       -0.81663143998451093},
  };
  for (const auto& c : cases) {
    INFO(c.p.x);
    CHECK(lattice_noise(c.p) == c.noise);
    CHECK(fractal_noise(c.p, {}) == c.sum);
    CHECK(turbulence(c.p, {}) == c.turbulence);
    CHECK(fractal_noise(c.p, {3.25, 1.9, 0.5}) == c.other_sum);
  }
}

TEST_CASE("noise is smooth, repeats itself after 4096 and has a value everywhere") {
  Dice dice(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = dice.point(500);
    const double noise = lattice_noise(p);
    CHECK(std::fabs(noise) < 2);
    CHECK(std::fabs(lattice_noise(p + Vec3{1e-6, -1e-6, 1e-6}) - noise) < 1e-4);
    const Vec3 whole{std::floor(16 * p.x) / 16, std::floor(16 * p.y) / 16,
                     std::floor(16 * p.z) / 16};
    const Vec3 positive = whole + Vec3{512, 512, 512};
    CHECK(lattice_noise(positive + Vec3{4096, 0, 8192}) == lattice_noise(positive));
    CHECK(lattice_noise(-p) == noise);
  }
  constexpr double kBig = std::numeric_limits<double>::max();
  CHECK(std::isfinite(lattice_noise({kBig, -kBig, 1e300})));
  CHECK(lattice_noise({kBig * 2, std::nan(""), 0.5}) == lattice_noise({0, 0, 0.5}));
  // Weights may leave the range of doubles; a colour comes out all the same.
  Pattern wild;
  wild.kind = PatternKind::kCamouflage;
  wild.octaves = {kMaxOctaves, 1e300, -1e300};
  const Rgb c = color_at(wild, {}, {0.3, 0.4, 0.5});
  CHECK((c == wild.colors[0] || c == wild.colors[1] || c == wild.colors[2]));
  wild.kind = PatternKind::kMarble;
  CHECK(color_at(wild, {1, 1, 1}, {0.3, 0.4, 0.5}).r >= 0);
}

TEST_CASE("camouflage has its colours by the noise at the mapped point") {
  Pattern m;
  m.kind = PatternKind::kCamouflage;
  m.colors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  m.to_pattern = compose(translation({1, 2, 3}), scaling({0.5, 0.25, 2}));
  int counts[3] = {};
  Dice dice(3);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = dice.point(20);
    const double noise = fractal_noise(m.to_pattern.point(p), m.octaves);
    const std::size_t expected = noise < -0.25 ? 0 : noise < 0.25 ? 1 : 2;
    ++counts[expected];
    CHECK(color_at(m, {9, 9, 9}, p) == m.colors[expected]);
  }
  for (const int count : counts) CHECK(count > 20);
}

TEST_CASE("marble mixes the material's colour with its own, by the sine of turbulence") {
  Pattern m;
  m.kind = PatternKind::kMarble;
  m.colors[0] = {0, 0, 1};
  const Vec3 p{0.3, 1.7, 2.2};
  const double vein = std::sin(3.14159265358979323846 * turbulence(p, m.octaves));
  const Rgb c = color_at(m, {1, 0, 0}, p);
  CHECK(c.r == Approx(vein));
  CHECK(c.b == Approx(1 - vein));
}

TEST_CASE("a checker's cubes have one colour or the other in turn, below 0, too") {
  Pattern m;
  m.kind = PatternKind::kChecker;
  m.colors = {{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}}};
  CHECK(color_at(m, {}, {0.5, 0.5, 0.5}) == m.colors[0]);
  CHECK(color_at(m, {}, {1.5, 0.5, 0.5}) == m.colors[1]);
  CHECK(color_at(m, {}, {-0.5, 0.5, 0.5}) == m.colors[1]);
  CHECK(color_at(m, {}, {-0.5, -1.5, 0.5}) == m.colors[1]);
  CHECK(color_at(m, {}, {-0.5, -0.5, 0.5}) == m.colors[0]);
}

TEST_CASE("without a pattern the colour is the material's") {
  CHECK(color_at({}, {0.2, 0.3, 0.4}, {1, 2, 3}) == Rgb{0.2, 0.3, 0.4});
}
