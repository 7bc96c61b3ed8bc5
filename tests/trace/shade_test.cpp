// The light of a hit, of shadow, reflected and refracted rays: section "Shading" of the scene
// format, worked out by hand.
#include <cmath>

#include "catch.hpp"
#include "one_ray.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const double kRoot2 = std::sqrt(2.0);

Material matt(const Rgb& color, double diffuse) {
  Material m = black();
  m.color = color;
  m.diffuse = diffuse;
  return m;
}

}  // namespace

TEST_CASE("a ray that hits nothing brings the background") {
  Stage stage;
  stage.settings().background = {0.25, 0.5, 3};
  const Glimpse g = stage.look();
  check_light(g.light, {0.25, 0.5, 3});
  CHECK(g.count(RayKind::kPrimary) == 1);
}

TEST_CASE("ambient light is the product of three, less what is let through") {
  Material m = glowing({0.5, 1, 0.25});
  m.ambient = 0.4;
  Stage stage;
  stage.settings().ambient = {1, 0.5, 2};
  SECTION("opaque") { check_light(stage.add(wall(0), m).look().light, {0.2, 0.2, 0.2}); }
  SECTION("half transparent") {
    m.transmit = 0.5;
    check_light(stage.add(wall(0), m).look().light, {0.1, 0.1, 0.1});
  }
}

TEST_CASE("diffuse light falls with the cosine and ignores distance") {
  // The light stands at 60° from the normal (0, 0, −1) of the wall.
  const double s = std::sqrt(0.75);
  for (const double distance : {1.0, 100.0}) {
    Stage stage;
    stage.add(wall(0), matt({1, 0.5, 0.25}, 0.8)).light(distance * Vec3{s, 0, -0.5}, {2, 1, 1});
    const Glimpse g = stage.look();
    check_light(g.light, {0.8, 0.2, 0.1});
    CHECK(g.count(RayKind::kShadow) == 1);
  }
}

TEST_CASE("a pattern's colour is that of the surface's point, in own, ambient and light's light") {
  Material chess = matt({9, 9, 9}, 1);
  chess.ambient = 0.5;
  chess.pattern.kind = PatternKind::kChecker;
  chess.pattern.colors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}};
  chess.pattern.to_pattern = translation({0.5, 0.5, 0.5});
  const auto look_at = [&](double x) {
    return Stage().add(wall(0), chess).light({x, 0, -5}).look({x, 0, -9}, {0, 0, 1}).light;
  };
  check_light(look_at(0), {1.5, 0, 0});
  check_light(look_at(1), {0, 1.5, 0});
}

TEST_CASE("a light with a beam lights what is in it, and sends no rays elsewhere") {
  const auto look = [](double angle_degrees) {
    Stage stage;
    // The light is seen 45 degrees off the axis of its beam.
    stage.add(wall(0), matt({1, 1, 1}, 1)).light({3, 0, -3});
    stage.settings().lights[0].direction = {0, 0, 5};
    stage.settings().lights[0].angle_degrees = angle_degrees;
    return stage.look();
  };
  const double lit = std::sqrt(0.5);
  check_light(look(180).light, {lit, lit, lit});
  check_light(look(45.001).light, {lit, lit, lit});
  CHECK(look(45.001).count(RayKind::kShadow) == 1);
  check_light(look(44.999).light, {0, 0, 0});
  CHECK(look(44.999).count(RayKind::kShadow) == 0);
  check_light(look(0).light, {0, 0, 0});
}

TEST_CASE("light with falloff is divided by the distance squared") {
  Stage stage;
  stage.add(wall(0), matt({1, 1, 1}, 1)).light({0, 0, -4}, {8, 16, 32}, Falloff::kInverseSquare);
  check_light(stage.look().light, {0.5, 1, 2});
}

TEST_CASE("the highlight is white and follows the mirror direction") {
  Material m = black();
  m.color = {1, 0, 0};
  m.specular = 0.5;
  m.shininess = 4;
  Stage stage;
  // The mirrored ray goes back along −z; lights at 0° and 60° from it.
  stage.add(wall(0), m)
      .light({0, 0, -3}, {1, 1, 1})
      .light({3 * std::sqrt(0.75), 0, -1.5}, {0, 16, 0});
  check_light(stage.look().light, {0.5, 0.5 + 0.5, 0.5});
}

TEST_CASE("light from behind the surface does nothing and casts no ray") {
  Material m = matt({1, 1, 1}, 1);
  m.specular = 1;
  m.shininess = 0;
  Stage stage;
  stage.add(block({-1, -1, 0}, {1, 1, 1}), m).light({0, 0, 5});
  const Glimpse g = stage.look();
  check_light(g.light, {0, 0, 0});
  CHECK(g.count(RayKind::kShadow) == 0);
}

TEST_CASE("an inner surface is lit on the side that is seen") {
  // The eye is inside a ball; the normal is turned against the ray.
  Stage stage;
  stage.add(ball({0, 0, 0}, 5), matt({1, 1, 1}, 1)).light({0, 0, 0});
  check_light(stage.look({0, 0, 1}, {0, 0, 1}).light, {1, 1, 1});
}

TEST_CASE("an opaque solid casts a shadow, and a shadow ray is counted all the same") {
  Stage stage;
  stage.add(wall(0), matt({1, 1, 1}, 1)).light({6, 0, -6});
  CHECK(stage.look().light.r == Approx(1 / kRoot2));
  SECTION("between surface and light") {
    stage.add(ball({3, 0, -3}, 0.5), black());
    const Glimpse g = stage.look();
    check_light(g.light, {0, 0, 0});
    CHECK(g.count(RayKind::kShadow) == 1);
  }
  SECTION("not beyond the light") {
    stage.add(ball({7, 0, -7}, 0.5), black());
    CHECK(stage.look().light.r == Approx(1 / kRoot2));
  }
  SECTION("not where the light lies on its surface") {
    stage.add(block({5, -1, -8}, {8, 1, -6}), black());
    CHECK(stage.look().light.r == Approx(1 / kRoot2));
  }
}

TEST_CASE("transparent solids dim light once at each surface") {
  Stage stage;
  stage.add(wall(0), matt({1, 1, 1}, 1)).light({6, 0, -6});
  SECTION("a glass ball counts twice") {
    stage.add(ball({3, 0, -3}, 0.5), glass(0.5, 1.5));
    CHECK(stage.look().light.r == Approx(0.25 / kRoot2));
  }
  SECTION("a hollow one four times") {
    stage.add(operation(Operation::kDifference, {ball({3, 0, -3}, 0.5), ball({3, 0, -3}, 0.4)}),
              glass(0.5, 1.5));
    CHECK(stage.look().light.r == Approx(0.0625 / kRoot2));
  }
  SECTION("a light inside it once") {
    stage.add(ball({6, 0, -6}, 0.5), glass(0.5, 1.5));
    CHECK(stage.look().light.r == Approx(0.5 / kRoot2));
  }
  SECTION("two of them by both") {
    stage.add(ball({3, 0, -3}, 0.5), glass(0.5, 1)).add(ball({4.5, 0, -4.5}, 0.5), glass(0.8, 1));
    CHECK(stage.look().light.r == Approx(0.25 * 0.64 / kRoot2));
  }
  SECTION("an opaque one among them ends it") {
    stage.add(ball({3, 0, -3}, 0.5), glass(0.5, 1)).add(ball({4.5, 0, -4.5}, 0.5), black());
    CHECK(stage.look().light.r == 0);
  }
}

TEST_CASE("the solid that a shadow ray starts on dims it too") {
  // The ray meets a glass ball from inside; the light is on the far side, through the ball.
  Material m = glass(0.5, 1);
  m.diffuse = 1;
  Stage stage;
  stage.settings().max_depth = 0;
  stage.add(ball({0, 0, 0}, 1), m).light({0, 0, -5});
  // At (0, 0, 1), normal turned to −z: the light passes the near side of the ball once.
  check_light(stage.look({0, 0, 0}, {0, 0, 1}).light, {0.25, 0.25, 0.25});
}

TEST_CASE("a mirror shows what it faces, weighted") {
  Stage stage;
  stage.settings().background = {1, 0.5, 0.25};
  // Tilted by 45°: the ray along +z leaves along +y.
  stage.add(node_of(HalfSpaceShape{{0, 1, -1}, 0}), mirror(0.5));
  stage.add(node_of(HalfSpaceShape{{0, -1, 0}, -7}), glowing({0, 1, 0}));
  const Glimpse g = stage.look();
  check_light(g.light, {0, 0.5, 0});
  CHECK(g.count(RayKind::kReflection) == 1);
  CHECK(g.count(RayKind::kRefraction) == 0);
}

TEST_CASE("generations are limited by max_depth") {
  // Between two parallel mirrors: each generation adds the glow of one of them.
  Material m = glowing({1, 1, 1});
  m.reflect = 0.5;
  for (const std::uint32_t depth : {0u, 1u, 2u, 7u}) {
    Stage stage;
    stage.settings().max_depth = depth;
    const Glimpse g = stage.add(wall(1), m)
                          .add(node_of(HalfSpaceShape{{0, 0, 1}, -1}), m)
                          .look({0, 0, 0}, {0, 0, 1});
    const double sum = 2 * (1 - std::pow(0.5, depth + 1));
    check_light(g.light, {sum, sum, sum});
    CHECK(g.count(RayKind::kReflection) == depth);
  }
}

TEST_CASE("a weight below min_weight ends a secondary ray, an equal one does not") {
  Material m = glowing({1, 1, 1});
  m.reflect = 0.5;
  Stage stage;
  stage.settings().max_depth = 50;
  stage.add(wall(1), m).add(node_of(HalfSpaceShape{{0, 0, 1}, -1}), m);
  stage.settings().min_weight = 0.125;
  CHECK(stage.look({0, 0, 0}, {0, 0, 1}).count(RayKind::kReflection) == 3);
  stage.settings().min_weight = 0.126;
  CHECK(stage.look({0, 0, 0}, {0, 0, 1}).count(RayKind::kReflection) == 2);
}

TEST_CASE("a refracted ray is displaced by a slab as Snell says") {
  // Falling at 45° on a slab of index 1.5 and thickness 1; it goes on in parallel.
  const double inside = std::asin(std::sin(std::atan(1.0)) / 1.5);
  const double across = std::tan(inside);
  Stage stage;
  stage.settings().background = {0, 0, 1};
  stage.add(block({-50, -50, 0}, {50, 50, 1}), glass(0.5, 1.5));
  // Enters at the origin, leaves at (across, 0, 1), then goes on at 45°.
  const Vec3 target = Vec3{across, 0, 1} + 5.0 * Vec3{1, 0, 1};
  const double sideways = GENERATE(-0.02, 0.0, 0.02);
  stage.add(ball(target + Vec3{sideways, 0, 0}, 0.01), glowing({1, 0, 0}));
  const Glimpse g = stage.look({-3, 0, -3}, {1, 0, 1});
  check_light(g.light, sideways == 0 ? Rgb{0.25, 0, 0} : Rgb{0, 0, 0.25});
  CHECK(g.count(RayKind::kRefraction) == 2);
  CHECK(g.count(RayKind::kReflection) == 0);
}

TEST_CASE("a camera inside glass refracts outwards") {
  // The ray comes from inside, at 30° to the normal, with an index of 1.5: the sine becomes 0.75.
  Stage stage;
  stage.settings().background = {0, 0, 1};
  stage.add(block({-50, -50, -50}, {50, 50, 0}), glass(0.5, 1.5));
  const Vec3 out{0.75, 0, std::sqrt(1 - 0.5625)};
  stage.add(ball(4.0 * out, 0.01), glowing({1, 0, 0}));
  const Vec3 d{0.5, 0, std::sqrt(0.75)};
  check_light(stage.look(-2.0 * d, d).light, {0.5, 0, 0});
}

TEST_CASE("total reflection keeps all light, whatever reflect and transmit are") {
  // A prism with a right angle: in through one leg, totally reflected at the hypotenuse, out
  // through the other.
  Material m = glass(0.5, 1.5);
  m.reflect = GENERATE(0.0, 0.3);
  Stage stage;
  stage.settings().max_depth = 3;
  stage.add(
      node_of(PolyhedronShape{
          {{{0, 0, -1}, 0}, {{0, 1, 0}, 0}, {{0, -1, 1}, 2}, {{1, 0, 0}, 1}, {{-1, 0, 0}, 1}}}),
      m);
  // Enters at z = 0, y = −1; the hypotenuse z = 2 + y is met at z = 1; leaves upwards through y =
  // 0.
  stage.add(node_of(HalfSpaceShape{{0, -1, 0}, -3}), glowing({1, 1, 1}));
  const Glimpse g = stage.look({0, -1, -5}, {0, 0, 1});
  check_light(g.light, {0.25, 0.25, 0.25});
  if (m.reflect == 0) {
    CHECK(g.count(RayKind::kReflection) == 1);
    CHECK(g.count(RayKind::kRefraction) == 2);
  }
}

TEST_CASE("an opaque surface reflects by its reflect alone, also from within") {
  // The eye is in an opaque solid with an index: no total reflection without transmission.
  Material m = mirror(0.25);
  m.ior = 1.5;
  Stage stage;
  stage.settings().max_depth = 1;
  stage.add(block({-50, -50, -50}, {50, 50, 0}), m);
  stage.add(ball({3, 0, -3}, 0.5), glowing({1, 1, 1}));
  const Glimpse g = stage.look({-3, 0, -3}, {1, 0, 1});  // at 45°, beyond the critical angle
  check_light(g.light, {0.25, 0.25, 0.25});
  CHECK(g.count(RayKind::kRefraction) == 0);
}

TEST_CASE("a surface that reflects and lets through does both") {
  Material m = glass(0.5, 1);
  m.reflect = 0.25;
  Stage stage;
  stage.settings().max_depth = 1;
  stage.add(block({-1, -1, 0}, {1, 1, 1}), m);
  stage.add(node_of(HalfSpaceShape{{0, 0, 1}, -20}), glowing({1, 0, 0}));  // behind the eye
  const Glimpse g = stage.look();
  check_light(g.light, {0.25, 0, 0});  // the refracted ray ends at the far side, black
  CHECK(g.count(RayKind::kReflection) == 1);
  CHECK(g.count(RayKind::kRefraction) == 1);
}

TEST_CASE("glass of index 1 only dims") {
  Stage stage;
  stage.settings().background = {1, 1, 1};
  stage.add(ball({0.3, 0.2, 0}, 1), glass(0.5, 1));
  check_light(stage.look().light, {0.25, 0.25, 0.25});
}

TEST_CASE("light is rounded to 2^-32, mended when it is no number, clamped when it is too much") {
  Stage stage;
  SECTION("a sum beyond the largest contribution is clamped and counted") {
    stage.add(wall(0), glowing({1e9, 0.5, 1048576}));
    const Glimpse g = stage.look();
    check_light(g.light, {1048576, 0.5, 1048576});
    CHECK(g.rounding.clamped == 1);
    CHECK(g.rounding.non_finite == 0);
  }
  SECTION("what isn't finite counts as nothing") {
    stage.settings().ambient = {1e300, 1, 1};
    stage.add(wall(0), glowing({1e300, 0.5, 0.5}));
    const Glimpse g = stage.look();
    check_light(g.light, {0, 0.5, 0.5});
    CHECK(g.rounding.non_finite == 1);
    CHECK(g.rounding.clamped == 0);
  }
  SECTION("each contribution is rounded by itself, to nearest") {
    const double unit = std::ldexp(1, -32);
    stage.add(wall(0), glowing({0.4 * unit, 0.6 * unit, 1.5 * unit}));
    const Glimpse g = stage.look();
    CHECK(g.light.r == 0);
    CHECK(g.light.g == unit);
    CHECK(g.light.b == 2 * unit);
  }
}
