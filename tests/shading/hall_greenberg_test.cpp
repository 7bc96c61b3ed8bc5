// Highlights on both sides of glass: numbers worked out by hand, and when there are none.
#include "shading/hall_greenberg.hpp"

#include <cmath>

#include "catch.hpp"
#include "shading/fresnel.hpp"
#include "shading/media.hpp"
#include "shading/phong.hpp"
#include "surfaces.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Material clear_glass(double ior, double shininess) {
  Material m = clean(ShadingModel::kHallGreenberg, ior);
  m.transmit = 1;
  m.shininess = m.optics.transmit_shininess = shininess;
  return m;
}

/// The direction down to a light that a ray from direction v sees through the plane.
Vec3 light_behind(const Vec3& v, double eta) { return *refracted(-v, {0, 1, 0}, eta); }

}  // namespace

TEST_CASE("a highlight is Fresnel's share, to the power of the normal's cosine") {
  Material m = clear_glass(1.5, 10);
  m.specular = 0.5;
  const auto look = [&](double v, double l) {
    return hall_greenberg(m, floor_from(tilted(v)), tilted(l).y, tilted(l)).r;
  };
  CHECK(look(0, 0) == Approx(0.5 * 0.04).epsilon(1e-13));
  const double at_50 = fresnel(std::cos(50 * kPi / 180), 1.5, 0);
  CHECK(look(50, -50) == Approx(0.5 * at_50).epsilon(1e-13));
  CHECK(look(70, -30) ==
        Approx(0.5 * at_50 * std::pow(std::cos(20 * kPi / 180), 10)).epsilon(1e-12));
}

TEST_CASE("diffuse light is Phong's, of what doesn't go through") {
  Material m = clear_glass(1.5, 10);
  m.color = {1, 0.5, 0.25};
  m.diffuse = 0.75;
  m.transmit = 0.25;
  m.specular = 0;
  CHECK(hall_greenberg(m, floor_from(tilted(30)), 0.5, tilted(60)) ==
        Rgb{0.28125, 0.140625, 0.0703125});
}

TEST_CASE("a light behind glass is brightest where the refracted ray goes, from either side") {
  for (const bool is_within : {false, true}) {
    const double eta = is_within ? 1.5 : 1 / 1.5;  // before the surface over behind it
    const Material m = clear_glass(1.5, 40);
    const Vec3 v = tilted(25);
    const SurfaceView at{{0, 1, 0}, v, is_within};
    const Vec3 through = light_behind(v, eta);
    const double passing = 1 - fresnel(v.y, is_within ? 1 / 1.5 : 1.5, 0);
    const Rgb straight = hall_greenberg_from_behind(m, at, through);
    CHECK(straight.r == Approx(passing).epsilon(1e-12));
    CHECK(straight == Rgb{straight.r, straight.r, straight.r});
    const double beside =
        hall_greenberg_from_behind(m, at, normalized(through + Vec3{0, 0, 0.05})).r;
    CHECK(beside < straight.r);
    CHECK(beside > 0);
  }
}

TEST_CASE("the highlight from behind is a power of the cosine to the normal that refracts so") {
  // Seen straight, with the light 10° off: h′ = −(1.5 l + v) / |…|.
  const Material m = clear_glass(1.5, 7);
  const Vec3 l = -tilted(10), v = tilted(0);
  const Vec3 h = normalized(-(1.5 * l + v));
  CHECK(hall_greenberg_from_behind(m, floor_from(v), l).r ==
        Approx((1 - fresnel(h.y, 1.5, 0)) * std::pow(h.y, 7)).epsilon(1e-12));
  Material weak = m;
  weak.specular = 0.5;
  weak.transmit = 0.25;
  CHECK(hall_greenberg_from_behind(weak, floor_from(v), l).r ==
        Approx(0.125 * (1 - fresnel(h.y, 1.5, 0)) * std::pow(h.y, 7)).epsilon(1e-12));
}

TEST_CASE(
    "no normal refracts light that comes from too far aside, or through what doesn't refract") {
  const Material m = clear_glass(1.5, 1);
  // In glass of index 1.5 light lies within 48.2° of the opposite direction: cos = −1/1.5.
  CHECK(hall_greenberg_from_behind(m, floor_from(tilted(0)), -tilted(48)).r > 0);
  CHECK(hall_greenberg_from_behind(m, floor_from(tilted(0)), -tilted(48.5)).r == 0);
  const Material air = clear_glass(1, 1);
  for (const double degrees : {0.0, 0.1, 30.0})
    CHECK(hall_greenberg_from_behind(air, floor_from(tilted(0)), -tilted(degrees)).r == 0);
}

TEST_CASE("only what lets light through and has highlights shows lights behind it") {
  Material m = clear_glass(1.5, 1);
  CHECK(has_light_from_behind(m));
  m.specular = 0;
  CHECK_FALSE(has_light_from_behind(m));
  m = clear_glass(1.5, 1);
  m.transmit = 0;
  CHECK_FALSE(has_light_from_behind(m));
  m = clear_glass(1.5, 1);
  m.model = ShadingModel::kTorranceSparrow;
  CHECK_FALSE(has_light_from_behind(m));
}

TEST_CASE("media are numbered among the materials that dim light, and dim it by the way's length") {
  std::vector<Material> materials(4, clear_glass(1.5, 1));
  materials[1].optics.attenuation = {0.5, 0, 2};
  materials[2].model = ShadingModel::kTorranceSparrow;
  materials[2].optics.attenuation = {1, 1, 1};
  materials[3].optics.attenuation = {0, 1e-9, 0};
  const Media media(materials);
  CHECK(media.count() == 2);
  CHECK(media.of(0) == 0);
  CHECK(media.of(1) == 1);
  CHECK(media.of(2) == 0);
  CHECK(media.of(3) == 2);
  const Rgb left = media.left_after(1, 3);
  CHECK(left.r == Approx(std::exp(-1.5)).epsilon(1e-14));
  CHECK(left.g == 1);
  CHECK(left.b == Approx(std::exp(-6.0)).epsilon(1e-14));
  CHECK(media.left_after(1, std::numeric_limits<double>::infinity()) == Rgb{0, 1, 0});
  CHECK(Media(std::span(materials).first(1)).empty());
}
