// Objects that may stand between surfaces and lights: foreign horizons must never promise a way
// that something foreign blocks.
#include "visibility/occluders.hpp"
#include "geometry/infinity.hpp"

#include <cmath>

#include "catch.hpp"
#include "crossings/surface_tree.hpp"
#include "csg/random_model.hpp"
#include "geometry/simd.hpp"
#include "visibility/cube_map.hpp"
#include "visibility/cube_texels.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

PointLight light_at(const Vec3& p) { return {p, {1, 1, 1}, Falloff::kNone}; }

Model lit_from_origin(std::vector<CsgNode> objects) {
  Scene scene = scene_of(std::move(objects));
  scene.settings.lights = {light_at({0, 0, 0})};
  return compile_scene(scene);
}

/// Balls in a row away from a light at the origin, along x, and one aside.
Model row_of_balls() {
  std::vector<CsgNode> balls;
  for (const Vec3& at : {Vec3{5, 0, 0}, Vec3{10, 0, 0}, Vec3{15, 0, 0}, Vec3{0, 10, 0}}) {
    balls.push_back(node_of(SphereShape{at, 1}));
  }
  return lit_from_origin(std::move(balls));
}

std::uint32_t texel_of(const Vec3& direction) {
  return static_cast<std::uint32_t>(cube_texel(cube_place(direction), LightHorizons::kSide));
}

}  // namespace

TEST_CASE("the horizons of all objects are those of the scene") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    CHECK(Occluders::of(model).horizons().maps() == LightHorizons::of(model).maps());
  }
}

TEST_CASE("nothing that a node does not hold is nearer to a light than its foreign horizon") {
  std::uint64_t promised = 0, beyond = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    Scene scene = RandomModel(seed).scene();
    for (PointLight& light : scene.settings.lights)
      light.position = dice.point(dice.one_in(2) ? 4.0 : 12.0);
    const Model model = compile_scene(scene);
    std::vector<bool> held(model.objects.size()), others(model.objects.size());
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = dice.one_in(2);
    for (std::size_t i = 0; i < held.size(); ++i) others[i] = !held[i];
    const ModelContents contents{held, {}};
    const Occluders occluders = Occluders::of(model);
    const LightHorizons foreign = occluders.foreign_horizons(contents, model);
    const LightHorizons all = occluders.horizons();
    const Model rest = extract(model, {others, {}});
    const SurfaceTree tree = SurfaceTree::build(rest);
    TreeScratch scratch;
    for (std::size_t light = 0; light < model.settings.lights.size(); ++light) {
      for (int i = 0; i < 200; ++i) {
        const Vec3 d = dice.unit_vector();
        const auto hit =
            tree.first_crossing({model.settings.lights[light].position, d}, 0, kInf, scratch);
        const double distance = foreign.distance(light, d);
        REQUIRE(distance <= (hit ? hit->t : kInf));
        promised += distance > 0 ? 1 : 0;
        const double of_all = all.distance(light, d);
        beyond += distance > of_all ? 1 : 0;
        // If nothing is bounded, the distances may be rounded to other units.
        REQUIRE(distance >= 0.995 * of_all);
      }
    }
  }
  CHECK(promised > 10'000);
  CHECK(beyond > 1000);
}

TEST_CASE("a part that a node holds counts as foreign, with the surfaces that it has there") {
  // The light is within the solid that is subtracted, and sees nothing before that ends; the first
  // box alone, held as a part, is nearer.
  const Model model = lit_from_origin(
      {operation(Operation::kDifference, {node_of(BoxShape{{4, -1, -1}, {9, 1, 1}}),
                                          node_of(BoxShape{{-2, -2, -2}, {8, 2, 2}})})});
  const auto distance = [&](const ModelContents& contents) {
    return Occluders::of(model).foreign_horizons(contents, model).distance(0, {1, 0, 0});
  };
  // The texel's directions are not quite the x axis.
  const double nothing_held = distance({{false}, {}}), whole = distance({{true}, {}});
  CHECK(whole == kInf);
  const auto tree = model.tree(model.objects[0]);
  REQUIRE(tree.size() == 3);
  TreeNode first_box = tree[1];
  const ModelContents part{{false}, {{0, {first_box}}}};
  CHECK(distance(part) <= 4);
  CHECK(distance(part) > 3.9);
  CHECK(nothing_held > 7.9);
}

TEST_CASE("occluders are chosen as rays ask for them") {
  const Model model = row_of_balls();
  const Occluders occluders = Occluders::of(model);
  const std::vector<std::size_t> bytes(4, 100);
  const OccluderQuery behind_two{0, texel_of({1, 0, 0}), 12};
  std::vector<bool> held(4);
  choose_occluders(occluders, {{behind_two}}, bytes, 1000, held);
  // An object farther from the light than the ray's surface, or elsewhere, is no occluder.
  CHECK(held == std::vector<bool>{true, true, false, false});
}

TEST_CASE(
    "occluders that serve most rays by the byte come first, and no more than there is room for") {
  const Model model = row_of_balls();
  const Occluders occluders = Occluders::of(model);
  const OccluderQuery far_x{0, texel_of({1, 0, 0}), 20}, far_y{0, texel_of({0, 1, 0}), 20};
  std::vector<bool> held(4);
  choose_occluders(occluders, {{far_x, far_x, far_y}}, {{100, 100, 100, 100}}, 100, held);
  CHECK(held == std::vector<bool>{false, false, false, true});
  held.assign(4, false);
  choose_occluders(occluders, {{far_x, far_x, far_y}}, {{10, 100, 100, 100}}, 100, held);
  CHECK(held == std::vector<bool>{true, false, false, false});
  held.assign(4, false);
  choose_occluders(occluders, {{far_x, far_x, far_y}}, {{100, 100, 100, 100}}, 99, held);
  CHECK(held == std::vector<bool>(4));
}

TEST_CASE("texels of many directions are those of each, with any instruction set") {
  Dice dice(1);
  std::array<double, 64> x, y, z;
  for (const std::string& name : simd_names()) {
    INFO(name);
    REQUIRE(choose_simd(name));
    for (int round = 0; round < 200; ++round) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        Vec3 d = dice.unit_vector();
        if (dice.one_in(8)) d[static_cast<int>(dice.below(3))] = 0;
        if (dice.one_in(8)) d = {d.x, d.x, -d.x};
        x[i] = d.x;
        y[i] = d.y;
        z[i] = d.z;
      }
      std::array<std::uint32_t, 64> texels;
      find_opposite_texels(x, y, z, x.size(), LightHorizons::kSide, texels);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Vec3 opposite{-x[i], -y[i], -z[i]};
        REQUIRE(texels[i] < LightHorizons::kTexels);
        REQUIRE(texels[i] == texel_of(opposite));
      }
    }
    // Vectors that are no direction get some texel.
    x.fill(std::nan(""));
    std::array<std::uint32_t, 64> texels;
    find_opposite_texels(x, y, z, x.size(), LightHorizons::kSide, texels);
    for (const std::uint32_t t : texels) REQUIRE(t < LightHorizons::kTexels);
  }
  REQUIRE(choose_simd("best"));
}

TEST_CASE("distances of many texels, as floats, are no longer than what they are of") {
  Dice dice(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> distances(LightHorizons::kTexels);
    const double reach = dice.between(0.01, 1000);
    for (float& d : distances)
      d = static_cast<float>(dice.one_in(9) ? INFINITY : dice.between(0, 1.2 * reach));
    const LightHorizons horizons({HorizonMap::of(distances, reach)});
    std::array<std::uint32_t, 64> texels;
    for (std::uint32_t& t : texels)
      t = static_cast<std::uint32_t>(dice.below(LightHorizons::kTexels));
    std::array<float, 64> found;
    horizons.distances_at(0, texels, found);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      REQUIRE(found[i] <= distances[texels[i]]);
      REQUIRE(found[i] >=
              std::min<double>(distances[texels[i]], reach) * (1 - 1e-5) - reach / 60'000);
    }
    horizons.distances_at(1, texels, found);
    REQUIRE(found == std::array<float, 64>{});
  }
}

TEST_CASE("a map's distances are a little shorter, or cut off at its reach") {
  std::vector<float> distances{0, 1, 99.5f, 100, 1e9f, kFloatInf};
  const HorizonMap map = HorizonMap::of(distances, 100);
  const std::vector<double> expected{0, 1, 99.5, 100, 100, kInf};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    INFO(i);
    CHECK(map.at(i) <= expected[i]);
    if (std::isfinite(expected[i])) CHECK(map.at(i) >= expected[i] - 100.0 / 65'000);
  }
  CHECK(HorizonMap::of(std::vector<float>(4), 100).empty());
}
