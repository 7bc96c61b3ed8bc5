// Eyes and lights that lie exactly on faces, and in places where a face would be if a flush cut
// left a skin.
#include <limits>
#include <optional>

#include "catch.hpp"
#include "coincidence/pair_rays.hpp"
#include "coincidence/touching_objects.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 48;

/// A point of the pair at which touching faces vanish, with no surface near: in a hole's mouth, or
/// between two parts.
std::optional<Vec3> vanished_face_point(const FlushPair& pair, Dice& dice, double& size) {
  const Model model = compile_scene(pair.longer);
  CrossingFinder finder(model);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Site& site = pair.sites[dice.below(pair.sites.size())];
    if (site.discs.empty()) continue;
    const Vec3& disc = site.discs[dice.below(site.discs.size())];
    const double r = 0.3 * disc.z;
    const Vec3 p = site.to_world.point({disc.x + dice.between(-r, r), disc.y + dice.between(-r, r),
                                        site.heights[dice.below(site.heights.size())]});
    size = site.world_size();
    bool is_clear = true;
    for (int i = 0; i < 24 && is_clear; ++i) {
      const auto crossings = finder.all({"", {p, dice.unit_vector()}, 0, size, false});
      is_clear = crossings.empty() || crossings.front().t > 1e-3 * size;
    }
    if (is_clear) return p;
  }
  return std::nullopt;
}

/// Calls `change(scene, point, size)` for pairs of all kinds that have such a point, and compares
/// their pictures. `apart`: for pairs without touching surfaces, to see whether the pictures can
/// agree at all.
template <typename Change>
void check_at_vanished_faces(const Change& change, bool apart) {
  PictureTally tally;
  std::size_t pictures = 0;
  for (std::uint64_t seed = 1; pictures < 80; ++seed) {
    REQUIRE(seed < 400);
    FlushPair pair = PairMaker(seed).make();
    if (apart) pair.flush = PairMaker(seed, {.tells_longer_anew = true}).make().longer;
    Dice dice(seed);
    double size = 0;
    const auto point = vanished_face_point(pair, dice, size);
    if (!point) continue;
    ++pictures;
    set_up_picture(pair, kSide);
    for (Scene* scene : {&pair.flush, &pair.longer}) change(*scene, *point, size);
    tally.add(pair.text(), picture_of(pair.flush), picture_of(pair.longer));
  }
  tally.check(0.3);
}

Material matt() { return coloured({0.9, 0.8, 0.7}); }

/// Two columns, one upon the other; they meet at z = 0.
struct Stack {
  Column below, above;
  static Stack some(Dice& dice) {
    const Stretch s{-0.5, 0.5, 0.1};
    const auto kind = [&] { return static_cast<ColumnKind>(dice.below(kColumnKinds - 3)); };
    const ColumnKind first = kind(), second = kind();
    return {Column(first, 0, 0, 1, s, dice), Column(second, 0.1, -0.1, 0.35, s, dice)};
  }
};

}  // namespace

namespace {

void put_eye(Scene& scene, const Vec3& point, double size) {
  Camera& c = scene.settings.camera;
  const Vec3 view = normalized(c.look_at - c.eye);
  c.projection = Projection::kPerspective;
  c.fov_degrees = 100;
  c.eye = point;
  c.look_at = point + size * view;
}
/// The light lies in the plane of the faces around, where it is for rounding to decide whether
/// there are highlights.
void put_light(Scene& scene, const Vec3& point, double) {
  scene.materials.front().material.specular = 0;
  scene.settings.lights = {{point, {1, 1, 1}, Falloff::kNone}};
}

}  // namespace

TEST_CASE("an eye in the mouth of a flush hole sees what it sees in a longer one") {
  check_at_vanished_faces(put_eye, false);
}

TEST_CASE("a light in the mouth of a flush hole lights what it lights in a longer one") {
  check_at_vanished_faces(put_light, false);
}

TEST_CASE(
    "an eye and a light in the mouth of a longer hole do the same whichever way leads to it") {
  check_at_vanished_faces(put_eye, true);
  check_at_vanished_faces(put_light, true);
}

TEST_CASE(
    "a light between two solids that touch lights nothing, whether they are one object or two") {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    const Stack stack = Stack::some(dice);
    Scene lit = scene_with_settings(moved_settings(settings_around_origin(dice, kSide), ways.map()),
                                    {matt()});
    lit.settings.lights = {{ways.map().point({0.1, -0.1, 0}), {1, 1, 1}, Falloff::kNone}};
    std::vector<CsgNode> solids{ways(stack.below.between(-0.5, 0)),
                                ways(stack.above.between(0, 0.5))};
    if (seed % 2 == 0) solids = {operation(Operation::kUnion, solids)};
    add_objects(lit, solids);
    add_objects(lit, {ways(node_of(HalfSpaceShape{{0, 0, 1}, -1}))});
    Scene dark = lit;
    dark.settings.lights.clear();
    tally.add("seed " + std::to_string(seed), picture_of(lit), picture_of(dark));
  }
  tally.check();
}

namespace {

/// A solid on a floor, of which a face lies at z = 0; the light `above` a point of the face.
Scene lit_from_face(std::uint64_t seed, double above, const Material& material) {
  Dice dice(seed);
  OtherWays ways(some_turn_and_move(dice), dice);
  const Stack stack = Stack::some(dice);
  Scene scene = scene_with_settings(moved_settings(settings_around_origin(dice, kSide), ways.map()),
                                    {material});
  scene.settings.lights = {{ways.map().point({-0.15, 0.4, above}), {1, 1, 1}, Falloff::kNone}};
  add_objects(scene, {ways(stack.below.between(-0.5, 0)), ways(stack.above.between(0, 0.5)),
                      ways(node_of(BoxShape{{-2, -2, -1}, {2, 2, -0.75}})),
                      ways(node_of(BoxShape{{-2, 1.5, -0.75}, {2, 2, 1}}))});
  return scene;
}

}  // namespace

TEST_CASE("a light on a face lights what one just before the face does") {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    tally.add("seed " + std::to_string(seed), picture_of(lit_from_face(seed, 0, matt())),
              picture_of(lit_from_face(seed, 2e-8, matt())));
  }
  tally.check();
}

TEST_CASE("a light in the plane of a face leaves no grains of highlights there") {
  PictureTally tally;
  Material shiny = matt();
  shiny.specular = 0.5;
  shiny.shininess = 3;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    // Alone, the solid shows no highlight at all: the light is in it, or in its upper face.
    const auto only_face = [&](double above) {
      Scene scene = lit_from_face(seed, above, shiny);
      scene.objects.resize(1);
      return picture_of(scene);
    };
    tally.add("seed " + std::to_string(seed), only_face(0), only_face(-2e-8));
  }
  tally.check();
}

namespace {

/// The number of a picture's rays that hit something at once.
std::size_t hits_at_once(const Scene& scene) {
  const Picture picture = picture_of(scene);
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.aov_planes[kDepthPlane].size(); i += 3) {
    count += std::bit_cast<float>(picture.aov_planes[kDepthPlane][i]) < 1e-9f ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("of the face that it lies on an eye sees nothing, or nothing else") {
  std::size_t some = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    const Stack stack = Stack::some(dice);
    Scene scene = scene_with_settings(settings_around_origin(dice, kSide), {matt()});
    Camera& c = scene.settings.camera;
    // The eye is on a face of one solid, or where two touch, and looks out of it or into it.
    c.eye = dice.one_in(2) ? Vec3{-0.2, 0.35, 0} : Vec3{0.15, -0.09, 0};
    c.look_at = c.eye + Vec3{0.1, 0.05, dice.sign()};
    c.up = {0, 1, 0};
    c.fov_degrees = 90;
    scene.settings = moved_settings(scene.settings, ways.map());
    std::vector<CsgNode> solids{ways(stack.below.between(-0.5, 0)),
                                ways(stack.above.between(0, 0.5))};
    if (seed % 3 == 0) solids = {operation(Operation::kUnion, solids)};
    add_objects(scene, std::move(solids));
    const std::size_t hits = hits_at_once(scene);
    CHECK((hits == 0 || hits == std::size_t{kSide} * kSide));
    some += hits > 0 ? 1 : 0;
  }
  CHECK(some > 5);
}
