// Light from rough surfaces: numbers worked out by hand, and what physics asks of any of them.
#include "shading/torrance_sparrow.hpp"

#include <cmath>

#include "catch.hpp"
#include "shading/fresnel.hpp"
#include "surfaces.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Material rough(double roughness, double ior, double absorption = 0) {
  Material m = clean(ShadingModel::kTorranceSparrow, ior, absorption);
  m.optics.roughness = roughness;
  return m;
}

double highlight(const Material& m, const Vec3& v, const Vec3& l) {
  return facet_highlight(m, floor_from(v), l.y, l).r;
}

}  // namespace

TEST_CASE("highlights are the facets' frequency, what grooves leave of it, and Fresnel's share") {
  const Material m = rough(0.25, 1.5);
  // Straight down and back: every level facet mirrors, none is hidden.
  CHECK(highlight(m, tilted(0), tilted(0)) == Approx(0.04 / (4 * 0.25 * 0.25)).epsilon(1e-13));
  // From 20° and 40° on one side: the facets are tilted by 30°, π / 6, and met at 10°.
  const double facets = std::exp(-std::pow(kPi / 6 / 0.25, 2)) / (4 * 0.25 * 0.25);
  CHECK(highlight(m, tilted(20), tilted(40)) ==
        Approx(fresnel(std::cos(kPi / 18), 1.5, 0) * facets / std::cos(kPi / 9)).epsilon(1e-13));
}

TEST_CASE("grooves shadow what is lit, and hide what is seen, from the side") {
  const Material m = rough(0.5, 1.5);
  const auto degrees = [](double a) { return std::cos(a * kPi / 180); };
  // Lit at 85°, seen from 55° on the other side: facets are tilted by 15°, met at 70°.
  const double facets = std::exp(-std::pow(kPi / 12 / 0.5, 2)) / (4 * 0.5 * 0.5);
  const double lit = 2 * degrees(15) * degrees(85) / degrees(70);
  REQUIRE(lit < 0.5);
  CHECK(highlight(m, tilted(55), tilted(-85)) ==
        Approx(fresnel(degrees(70), 1.5, 0) * facets * lit / degrees(55)).epsilon(1e-12));
  const double seen = 2 * degrees(15) / degrees(70);
  CHECK(highlight(m, tilted(85), tilted(-55)) ==
        Approx(fresnel(degrees(70), 1.5, 0) * facets * seen).epsilon(1e-12));
}

TEST_CASE("the highlight of a rough surface lies beyond the mirror direction") {
  // The paper's point: seen from 70°, most light doesn't come from −70°.
  const Material m = rough(0.4, 1.5);
  double brightest = 0, at = 0;
  for (double degrees = 40; degrees < 90; degrees += 0.5) {
    const double light = highlight(m, tilted(degrees), tilted(-60));
    if (light <= brightest) continue;
    brightest = light;
    at = degrees;
  }
  CHECK(at > 70);
}

TEST_CASE("a path of light is the same both ways") {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Material m =
        rough(dice.between(0.05, 1), dice.between(0.2, 3), dice.one_in(2) ? 0 : dice.between(0, 5));
    const Vec3 v = upward(dice), l = upward(dice);
    CHECK(highlight(m, v, l) / l.y == Approx(highlight(m, l, v) / v.y).epsilon(1e-9));
  }
}

TEST_CASE("a rough surface in light from everywhere sends back no more than falls on it") {
  // With a perfect mirror's index; a little less comes back as facets don't cover all.
  for (const double roughness : {0.05, 0.2, 0.5, 1.0}) {
    for (const double degrees : {0.0, 45.0, 75.0, 88.0}) {
      const Material m = rough(roughness, 0.001, 1000);
      const double all =
          lit_from_everywhere([&](const Vec3& l) { return highlight(m, tilted(degrees), l); });
      INFO(roughness << " seen at " << degrees << ": " << all);
      CHECK(all <= 1.002);
      if (degrees == 0 && roughness <= 0.2) CHECK(all > 0.9);
    }
  }
}

TEST_CASE("diffuse light of a rough surface is Phong's, of what doesn't go through") {
  Material m = rough(0.2, 1.5);
  m.color = {1, 0.5, 0.25};
  m.diffuse = 0.75;
  m.transmit = 0.25;
  m.specular = 0;
  CHECK(torrance_sparrow(m, floor_from(tilted(30)), 0.5, tilted(60)) ==
        Rgb{0.28125, 0.140625, 0.0703125});
  m.specular = 0.5;
  const Rgb with = torrance_sparrow(m, floor_from(tilted(30)), 0.5, tilted(-60));
  CHECK(with.r - 0.28125 == Approx(0.5 * highlight(m, tilted(30), tilted(-60))));
}

TEST_CASE("a rough surface has a finite highlight from every direction") {
  const Material m = rough(kLeastRoughness, 1.5);
  const Vec3 level{1, 0, 0};
  CHECK(highlight(m, level, tilted(45)) == 0);
  CHECK(highlight(m, tilted(89.999999), tilted(-89.999999)) >= 0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Vec3 v = upward(dice), l = dice.one_in(3) ? Vec3{-v.x, v.y, -v.z} : upward(dice);
    const double light = highlight(m, v, l);
    CHECK((light >= 0 && std::isfinite(light)));
  }
}
