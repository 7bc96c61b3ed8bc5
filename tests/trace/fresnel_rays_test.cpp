// Rays and light of Hall–Greenberg's and Torrance–Sparrow's materials: docs/shading.md, by hand.
#include <cmath>

#include "catch.hpp"
#include "one_ray.hpp"
#include "shading/fresnel.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Glass that mirrors and lets through all that Fresnel's equations give it.
Material clear(double ior, const Rgb& attenuation = {0, 0, 0}) {
  Material m = black();
  m.model = ShadingModel::kHallGreenberg;
  m.reflect = m.transmit = 1;
  m.ior = ior;
  m.optics.index = {ior, ior, ior};
  m.optics.attenuation = attenuation;
  return m;
}

/// A stage in even, white light.
Stage white_stage(std::uint32_t max_depth) {
  Stage stage;
  stage.settings().background = {1, 1, 1};
  stage.settings().max_depth = max_depth;
  return stage;
}

Rgb left_after(const Rgb& a, double distance) {
  return {std::exp(-a.r * distance), std::exp(-a.g * distance), std::exp(-a.b * distance)};
}

const Rgb kTint{0.5, 0, 1.25};

}  // namespace

TEST_CASE("a ray's light is parted by Fresnel's equations") {
  Material m = clear(1.5);
  const double degrees = GENERATE(0.0, 30.0, 75.0);
  const double a = degrees * 3.14159265358979323846 / 180;
  const double mirrored = fresnel(std::cos(a), 1.5, 0);
  SECTION("what isn't mirrored goes through") {
    m.reflect = 0;
    m.transmit = 0.75;
    Stage stage = white_stage(1);
    const Glimpse g = stage.add(wall(0), m).look({0, 0, -1}, {std::tan(a), 0, 1});
    const double through = 0.75 * (1 - mirrored);
    check_light(g.light, {through, through, through});
    CHECK(g.count(RayKind::kReflection) == 0);
    CHECK(g.count(RayKind::kRefraction) == 1);
  }
  SECTION("what doesn't go through is mirrored") {
    m.transmit = 0;
    m.reflect = 0.75;
    Stage stage = white_stage(1);
    const Glimpse g = stage.add(wall(0), m).look({0, 0, -1}, {std::tan(a), 0, 1});
    check_light(g.light, {0.75 * mirrored, 0.75 * mirrored, 0.75 * mirrored});
    CHECK(g.count(RayKind::kRefraction) == 0);
  }
}

TEST_CASE("clear glass can't be seen in even light, however often rays part in it") {
  for (const double ior : {1.1, 1.5, 2.4, 0.7}) {
    for (const double aside : {0.0, 0.5, 0.9, 0.99}) {
      Stage stage = white_stage(18);
      const Glimpse g = stage.add(ball({0, 0, 0}, 1), clear(ior)).look({aside, 0, -5}, {0, 0, 1});
      INFO(ior << ' ' << aside << ": " << g.light.r);
      CHECK(g.light.r <= 1 + 1e-7);
      // What is missing is still in the ball after 18 generations.
      CHECK(g.light.r > (ior == 2.4 || ior == 0.7 ? 0.9 : 0.999));
    }
  }
}

TEST_CASE("on total reflection nothing is lost to the surface that would have let it through") {
  // In through one leg of a prism, off its hypotenuse, out through the other leg.
  Material m = clear(1.5);
  m.reflect = GENERATE(0.0, 0.3, 0.9);
  m.transmit = 0.5;
  Stage stage;
  stage.settings().max_depth = 3;
  stage.add(
      node_of(PolyhedronShape{
          {{{0, 0, -1}, 0}, {{0, 1, 0}, 0}, {{0, -1, 1}, 2}, {{1, 0, 0}, 1}, {{-1, 0, 0}, 1}}}),
      m);
  stage.add(node_of(HalfSpaceShape{{0, -1, 0}, -3}), glowing({1, 1, 1}));
  const Glimpse g = stage.look({0, -1, -5}, {0, 0, 1});
  const double light = 0.48 * std::max(0.5, m.reflect) * 0.48;
  check_light(g.light, {light, light, light});
}

TEST_CASE("a medium dims what a ray brings by the length of its way in it") {
  Material m = clear(1, kTint);
  SECTION("through a slab, and no more beyond it") {
    Stage stage = white_stage(5);
    check_light(stage.add(block({-9, -9, 0}, {9, 9, 2}), m).look().light, left_after(kTint, 2));
  }
  SECTION("up to an object within the solid") {
    Stage stage = white_stage(5);
    stage.add(block({-9, -9, 0}, {9, 9, 8}), m).add(ball({0, 0, 4}, 1), glowing({1, 0.5, 1}));
    const Rgb left = left_after(kTint, 3);
    check_light(stage.look().light, {left.r, 0.5 * left.g, left.b});
  }
  SECTION("from an eye within it") {
    Stage stage = white_stage(5);
    stage.add(block({-9, -9, -9}, {9, 9, 9}), m);
    check_light(stage.look({0, 0, 2}, {0, 0, 1}).light, left_after(kTint, 7));
  }
  SECTION("off a mirror within it, both ways") {
    Stage stage = white_stage(5);
    stage.add(block({-9, -9, 0}, {9, 9, 8}), m).add(block({-1, -1, 3}, {1, 1, 4}), mirror(0.5));
    const Rgb left = left_after(kTint, 6);
    check_light(stage.look().light, {0.5 * left.r, 0.5 * left.g, 0.5 * left.b});
  }
  SECTION("without an end nothing comes through") {
    Stage stage = white_stage(5);
    check_light(stage.add(wall(0), m).look().light, {0, 1, 0});
  }
  SECTION("between mirrored rays of the solid itself") {
    // Of index 3 a quarter is mirrored at each face; the ray from the far face is mirrored again.
    Stage stage = white_stage(3);
    m = clear(3, kTint);
    stage.add(block({-9, -9, 0}, {9, 9, 2}), m);
    const Rgb once = left_after(kTint, 2), thrice = left_after(kTint, 6),
              twice = left_after(kTint, 4);
    const auto light = [](double a, double b, double) {
      // Off the front; through both faces; in, off the far face and out in front. (The way with
      // three lengths ends inside, in generation 3.)
      return 0.25 + 0.75 * a * 0.75 + 0.75 * 0.25 * b * 0.75;
    };
    check_light(stage.look().light,
                {light(once.r, twice.r, thrice.r), light(once.g, twice.g, thrice.g),
                 light(once.b, twice.b, thrice.b)});
  }
}

TEST_CASE("the last generation's own light is dimmed, too, and weights count what is left") {
  Material m = clear(1, {1, 1, 1});
  m.ambient = 1;
  m.transmit = 0.5;
  Stage stage;
  stage.settings().max_depth = 5;
  stage.add(block({-9, -9, 0}, {9, 9, 2}), m);
  const double near = 0.5, far = 0.5 * 0.5 * std::exp(-2.0);
  check_light(stage.look().light, {near + far, near + far, near + far});
  CHECK(stage.look().count(RayKind::kRefraction) == 2);
  // The ray that leaves would weigh 0.25 e⁻².
  stage.settings().min_weight = 0.04;
  CHECK(stage.look().count(RayKind::kRefraction) == 1);
}

TEST_CASE("a light behind glass shows in it, through both of its faces") {
  Material m = clear(1.5);
  m.reflect = 0;
  m.transmit = 0.5;
  m.specular = 0.8;
  Stage stage;
  stage.settings().max_depth = 1;
  stage.add(block({-9, -9, 0}, {9, 9, 1}), m).light({0, 0, 5}, {1, 0.5, 0});
  SECTION("in full where the refracted ray goes") {
    // At the front its way crosses the back; at the back, seen through the front, it crosses none.
    const double front = 0.8 * 0.5 * 0.96 * 0.5, back = 0.5 * 0.96 * (0.8 * 0.5 * 0.96);
    const Glimpse g = stage.look();
    check_light(g.light, {front + back, 0.5 * (front + back), 0});
    CHECK(g.count(RayKind::kShadow) == 2);
  }
  SECTION("not if something stands between") {
    stage.add(ball({0, 0, 3}, 0.5), black());
    const Glimpse g = stage.look();
    check_light(g.light, {0, 0, 0});
    CHECK(g.count(RayKind::kShadow) == 2);
  }
}

TEST_CASE("only glass of that model, with highlights, asks for lights behind it") {
  const auto shadows = [](const Material& m) {
    Stage stage;
    stage.settings().max_depth = 0;
    return stage.add(wall(0), m).light({0, 0, 5}).look().count(RayKind::kShadow);
  };
  Material m = clear(1.5);
  CHECK(shadows(m) == 0);
  m.specular = 1;
  CHECK(shadows(m) == 1);
  m.model = ShadingModel::kTorranceSparrow;
  CHECK(shadows(m) == 0);
  m.model = ShadingModel::kPhong;
  CHECK(shadows(m) == 0);
}

TEST_CASE("a metal colours what it mirrors, and the highlights of both models") {
  Material gold = black();
  gold.reflect = 0.5;
  gold.specular = 0.5;
  gold.optics.index = {0.14, 0.37, 1.44};
  gold.optics.absorption = {4.1, 2.3, 1.9};
  gold.optics.roughness = 0.5;
  gold.model = GENERATE(ShadingModel::kTorranceSparrow, ShadingModel::kHallGreenberg);
  const Rgb mirrored = fresnel(gold, 1, false);
  CHECK(mirrored.r > mirrored.b + 0.3);
  Stage stage = white_stage(1);
  check_light(stage.add(wall(0), gold).look().light, 0.5 * mirrored);
  // The light is at the eye: facets are met straight, and 1 / (4 m²) is 1.
  stage.settings().background = {0, 0, 0};
  check_light(stage.light({0, 0, -3}).look().light, 0.5 * mirrored);
}
