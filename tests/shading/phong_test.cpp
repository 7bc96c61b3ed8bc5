// Directions and the Phong model, worked out by hand.
#include "shading/phong.hpp"

#include <cmath>
#include <cstdint>

#include "catch.hpp"
#include "csg/dice.hpp"

using namespace graycube;
using graycube::testing::Dice;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A direction coming down in the x-y plane, so many degrees from the normal (0, 1, 0).
Vec3 falling(double degrees) {
  const double a = degrees * kPi / 180;
  return {std::sin(a), -std::cos(a), 0};
}
const Vec3 kUp{0, 1, 0};

void check_near(const Vec3& a, const Vec3& b, double tolerance = 1e-14) {
  INFO(a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z);
  CHECK(length(a - b) <= tolerance);
}
void check_near(const Rgb& a, const Rgb& b) {
  check_near(Vec3{a.r, a.g, a.b}, Vec3{b.r, b.g, b.b}, 1e-13);
}

/// Angle from −normal, in degrees.
double depth_angle(const Vec3& d) { return std::atan2(std::hypot(d.x, d.z), -d.y) * 180 / kPi; }

}  // namespace

TEST_CASE("a mirror turns the part along the normal round") {
  check_near(reflected({0.6, -0.8, 0}, kUp), {0.6, 0.8, 0});
  check_near(reflected({0, -1, 0}, kUp), {0, 1, 0});
  check_near(reflected({1, 0, 0}, kUp), {1, 0, 0});
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Vec3 d = dice.unit_vector(), n = dice.unit_vector();
    const Vec3 r = reflected(d, n);
    CHECK(std::fabs(length(r) - 1) < 1e-14);
    CHECK(std::fabs(dot(r, n) + dot(d, n)) < 1e-14);
    check_near(cross(r, n), cross(d, n));
    check_near(reflected(r, n), d);
  }
}

TEST_CASE("refraction follows Snell's law") {
  // 30° into glass of index 1.5: the sine becomes 1/3.
  const auto into_glass = refracted(falling(30), kUp, 1 / 1.5);
  REQUIRE(into_glass);
  CHECK(depth_angle(*into_glass) == Approx(19.47122063449069).epsilon(1e-12));
  // And back: 19.47° in glass becomes 30°.
  const auto out = refracted(falling(19.47122063449069), kUp, 1.5);
  REQUIRE(out);
  CHECK(depth_angle(*out) == Approx(30).epsilon(1e-12));
  check_near(*refracted(falling(0), kUp, 1 / 2.4), {0, -1, 0});
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Vec3 n = dice.unit_vector();
    Vec3 d = dice.unit_vector();
    if (dot(d, n) > 0) d = -d;
    const double eta = dice.between(0.3, 3);
    const double sine = length(cross(d, n));
    const auto t = refracted(d, n, eta);
    REQUIRE(t.has_value() == (eta * sine <= 1));
    if (!t) continue;
    CHECK(std::fabs(length(*t) - 1) < 1e-14);
    CHECK(dot(*t, n) <= 0);
    check_near(cross(*t, n), eta * cross(d, n), 1e-13);  // the sines, and one plane
  }
}

TEST_CASE("an index of 1 changes no direction") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Dice dice(seed);
    const Vec3 n = dice.unit_vector();
    Vec3 d = dice.unit_vector();
    if (dot(d, n) > 0) d = -d;
    INFO("seed " << seed);
    const auto t = refracted(d, n, 1);
    REQUIRE(t);
    check_near(*t, d, 1e-13);
  }
}

TEST_CASE("total reflection begins at the critical angle") {
  const double critical = std::asin(1 / 1.5) * 180 / kPi;  // 41.81°
  CHECK(refracted(falling(critical - 1e-6), kUp, 1.5));
  CHECK_FALSE(refracted(falling(critical + 1e-6), kUp, 1.5));
  CHECK(refracted(falling(89.99), kUp, 1 / 1.5));     // never from the thinner side
  CHECK_FALSE(refracted(falling(60), kUp, 1 / 0.6));  // ior below 1 swaps the sides
}

TEST_CASE("Phong's terms by hand") {
  Material m;
  m.color = {0.5, 1, 0.25};
  m.diffuse = 0.8;
  m.specular = 0.5;
  m.shininess = 10;
  m.transmit = 0.25;
  const Vec3 r = falling(120);  // 60° beyond the normal, going up
  SECTION("in the mirror direction the highlight is whole") {
    check_near(phong(m, 0.5, r, r), {0.5 * 0.3 + 0.5, 0.3 + 0.5, 0.25 * 0.3 + 0.5});
  }
  SECTION("beside it by 60° its power of the cosine") {
    const double highlight = 0.5 / 1024;
    check_near(phong(m, 1, r, kUp), {0.3 + highlight, 0.6 + highlight, 0.15 + highlight});
  }
  SECTION("behind it there is none") { check_near(phong(m, 1, r, -r), {0.3, 0.6, 0.15}); }
  SECTION("a shininess of zero shines everywhere") {
    m.shininess = 0;
    check_near(phong(m, 1, r, -r), {0.8, 1.1, 0.65});
  }
  SECTION("neither specular nor diffuse light is none") {
    m.specular = 0;
    m.diffuse = 0;
    CHECK(phong(m, 1, r, r) == Rgb{0, 0, 0});
  }
}
