// Light as BRL-CAD's rt reckons it: section "As rt shades" of the scene format, by hand.
#include <cmath>

#include "catch.hpp"
#include "one_ray.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Material rt(double diffuse, double specular, double shininess) {
  Material m;
  m.model = ShadingModel::kRt;
  m.color = {1, 0.5, 0.25};
  m.ambient = 0.4;
  m.diffuse = diffuse;
  m.specular = specular;
  m.shininess = shininess;
  return m;
}

/// A wall through the origin that a ray along +z meets at 60° from its normal.
CsgNode slope() { return node_of(HalfSpaceShape{{std::sqrt(0.75), 0, -0.5}, 0}); }

}  // namespace

TEST_CASE("rt's ambient light falls with the cosine of the view") {
  check_light(Stage().add(wall(0), rt(0, 0, 10)).look().light, {0.4, 0.2, 0.1});
  check_light(Stage().add(slope(), rt(0, 0, 10)).look().light, {0.2, 0.1, 0.05});
}

TEST_CASE("rt's highlight is Schlick's") {
  // The light stands at 60° from the normal, which is the mirror direction here: the highlight is
  // seen at 60°, too, and 1/2 / (10 − 5 + 1/2).
  Stage stage;
  const double s = std::sqrt(0.75);
  stage.add(wall(0), rt(0.3, 0.7, 10)).light(4 * Vec3{s, 0, -0.5}, {1, 1, 1});
  const double highlight = 0.7 * 0.5 / (10 - 10 * 0.5 + 0.5);
  check_light(stage.look().light,
              {0.4 + 0.15 + highlight, 0.2 + 0.075 + highlight, 0.1 + 0.0375 + highlight});
}

TEST_CASE("what rt's surfaces mirror and let through takes from all of their own light") {
  Material m = rt(0.3, 0.7, 10);
  m.reflect = 0.25;
  Stage stage;
  stage.settings().background = {1, 1, 1};
  check_light(stage.add(wall(0), m).look().light, {0.55, 0.4, 0.325});
}

TEST_CASE("rt's glass colours light once, where it enters, and is dark within") {
  Material m = rt(0.3, 0.7, 10);
  m.transmit = 0.5;
  Stage stage;
  stage.settings().background = {1, 1, 1};
  stage.add(block({-1, -1, 0}, {1, 1, 3}), m);
  check_light(stage.look().light, {0.2 + 0.5, 0.1 + 0.25, 0.05 + 0.125});
}

TEST_CASE("a lamp of rt is half as bright at its rim, and keeps no light from anything") {
  Material lamp = rt(0, 0, 1);
  lamp.model = ShadingModel::kRtLamp;
  lamp.ambient = 0.8;
  lamp.transmit = 1;
  check_light(Stage().add(slope(), lamp).look().light, {0.6, 0.3, 0.15});
  // The light stands in the middle of a lamp.
  Stage stage;
  stage.add(wall(0), rt(0.3, 0, 1)).add(ball({3, 0, -3}, 1), lamp).light({3, 0, -3});
  const double lit = 0.3 * std::sqrt(0.5);
  check_light(stage.look().light, {0.4 + lit, 0.2 + 0.5 * lit, 0.1 + 0.25 * lit});
}

TEST_CASE("a light without shadows lights what it can't see, and sends no rays") {
  const auto look = [](bool shadows) {
    Stage stage;
    stage.add(wall(0), rt(0.5, 0, 1)).add(ball({0, 2, -2}, 0.5), black()).light({0, 4, -4});
    stage.settings().lights[0].shadows = shadows;
    return stage.look();
  };
  const double lit = 0.5 * std::sqrt(0.5);
  check_light(look(true).light, {0.4, 0.2, 0.1});
  const Glimpse g = look(false);
  check_light(g.light, {0.4 + lit, 0.2 + 0.5 * lit, 0.1 + 0.25 * lit});
  CHECK(g.count(RayKind::kShadow) == 0);
}
