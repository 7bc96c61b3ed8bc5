// Faces shared by different objects, under turns: the first object in the file wins everywhere, and
// rays that start on such a face go on as they do if all coordinates are short.

#include "catch.hpp"
#include "coincidence/touching_objects.hpp"
#include "trace/machine.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 64;
constexpr std::uint64_t kScenes = 24;

std::vector<CsgNode> all_told(const std::vector<CsgNode>& solids, OtherWays& ways) {
  std::vector<CsgNode> told;
  for (const CsgNode& s : solids) told.push_back(ways(s));
  return told;
}

const std::vector<Material> kMatter{coloured({0.9, 0.2, 0.1}), coloured({0.1, 0.8, 0.2}),
                                    coloured({0.2, 0.3, 0.9})};

Material clear_glass() {
  Material m = coloured({0.8, 0.9, 1});
  m.diffuse = 0.1;
  m.transmit = 0.8;
  m.reflect = 0.1;
  m.ior = 1.5;
  return m;
}
Material mirror_like() {
  Material m = coloured({0.7, 0.7, 0.6});
  m.reflect = 0.4;
  return m;
}

}  // namespace

TEST_CASE("of two objects with faces in one plane the first in the file shows wherever both are") {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= 2 * kScenes; ++seed) {
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    const RenderSettings settings = moved_settings(settings_around_origin(dice, kSide), ways.map());
    const Stretch s{-0.5, 0.5, 0.1};
    const Column broad(static_cast<ColumnKind>(dice.below(kColumnKinds - 3)), 0, 0, 1.5, s, dice);
    const Column narrow(static_cast<ColumnKind>(dice.below(kColumnKinds - 3)), 0.3, -0.2, 0.6, s,
                        dice);
    const bool broad_first = dice.one_in(2);
    Scene flush = scene_with_settings(settings, kMatter), lower = flush;
    const auto add = [&](Scene& scene, double under) {
      const double b = broad_first ? 0 : under, n = broad_first ? under : 0;
      std::vector<CsgNode> solids{ways(broad.between(s.lo + b, s.hi - b)),
                                  ways(narrow.between(s.lo + n, s.hi - n))};
      if (!broad_first) std::swap(solids[0], solids[1]);
      add_objects(scene, std::move(solids));
    };
    add(flush, 0);
    add(lower, 1e-6);
    tally.add("seed " + std::to_string(seed), picture_of(flush), picture_of(lower));
  }
  tally.check();
}

TEST_CASE("parts stand on a table, and boxes side by side, as if they reached into each other") {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    Scene touching = scene_with_settings(
        moved_settings(settings_around_origin(dice, kSide), ways.map()), {mirror_like()});
    Scene sunk = touching;
    const Stretch s{0, 1, 0.2};
    const Column part(static_cast<ColumnKind>(dice.below(kColumnKinds - 3)), -0.4, 0.1, 0.6, s,
                      dice);
    const CsgNode table = node_of(BoxShape{{-2, -2, -0.5}, {2, 2, 0}});
    const CsgNode shelf = node_of(BoxShape{{2, -1, -0.5}, {2.5, 1, 0.25}});
    const CsgNode tenon = node_of(BoxShape{{1.9, -0.9, -0.4}, {2.1, 0.9, -0.1}});
    add_objects(touching, {ways(part.between(0, 1)), ways(table), ways(shelf)});
    add_objects(sunk, {ways(part.between(-0.1, 1)), ways(table),
                       operation(Operation::kUnion, {ways(shelf), ways(tenon)})});
    tally.add("seed " + std::to_string(seed), picture_of(touching), picture_of(sunk));
  }
  tally.check();
}

TEST_CASE(
    "opaque objects of one material that touch or are level with each other look like their "
    "union") {
  PictureTally tally;
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    Scene apart = scene_with_settings(settings_around_origin(dice, kSide), {mirror_like()});
    const std::vector<CsgNode> solids = touching_solids(dice);
    Scene one = apart;
    add_objects(one, {operation(Operation::kUnion, solids)});
    apart.settings = moved_settings(apart.settings, ways.map());
    add_objects(apart, all_told(solids, ways));
    tally.add("seed " + std::to_string(seed), picture_of(apart), picture_of(one));
  }
  tally.check();
}

namespace {

/// Counts pixels whose first hits differ in object, depth or normal between two pictures, where a
/// rigid map leads from one scene to the other.
std::size_t pixels_of_other_hits(const Picture& turned, const Picture& unturned,
                                 const Affine& map) {
  std::size_t count = 0;
  const auto number = [](const Picture& p, std::size_t plane, std::size_t i) {
    return std::bit_cast<float>(p.aov_planes[plane][i]);
  };
  const auto normal = [&](const Picture& p, std::size_t i) {
    return Vec3{number(p, kNormalPlane, i), number(p, kNormalPlane, i + 1),
                number(p, kNormalPlane, i + 2)};
  };
  for (std::size_t i = 0; i < unturned.aov_planes[kDepthPlane].size(); i += 3) {
    const auto object = unturned.aov_planes[kDepthPlane][i + 1];
    const float depth = number(unturned, kDepthPlane, i);
    const bool same =
        turned.aov_planes[kDepthPlane][i + 1] == object &&
        (object == 0 || (std::fabs(number(turned, kDepthPlane, i) - depth) <= 1e-5f * depth &&
                         length(normal(turned, i) - map.vector(normal(unturned, i))) < 1e-5));
    count += same ? 0 : 1;
  }
  return count;
}

/// Compares pictures of solids in all materials, or all of glass, turned and not. `apart`: every
/// solid is a little smaller and moved a little, so that no faces coincide.
void check_turned_and_unturned(bool apart) {
  PictureTally tally;
  std::size_t other_hits = 0;
  for (std::uint64_t seed = 1; seed <= 2 * kScenes; ++seed) {
    Dice dice(seed);
    OtherWays ways(some_turn_and_move(dice), dice);
    std::vector<Material> materials{kMatter[0], kMatter[1], kMatter[2], clear_glass(),
                                    mirror_like()};
    if (seed % 2 == 0) materials = {clear_glass()};
    Scene unturned = scene_with_settings(settings_around_origin(dice, kSide), materials);
    std::vector<CsgNode> solids = touching_solids(dice);
    for (std::size_t i = 0; apart && i < solids.size(); ++i) {
      const double by = static_cast<double>(i + 1), size = 0.99 - 0.003 * by;
      solids[i] = transformed(solids[i], compose(translation(by * Vec3{0.003, 0.005, 0.007}),
                                                 scaling({size, size, size})));
    }
    Scene turned = unturned;
    turned.settings = moved_settings(unturned.settings, ways.map());
    add_objects(unturned, solids);
    add_objects(turned, all_told(solids, ways));
    const Picture found = picture_of(turned), expected = picture_of(unturned);
    tally.add("seed " + std::to_string(seed), found, expected);
    other_hits += pixels_of_other_hits(found, expected, ways.map());
  }
  tally.check();
  CHECK(other_hits <= 3);
}

}  // namespace

TEST_CASE("touching objects of matter, glass and mirrors look the same turned and unturned") {
  check_turned_and_unturned(false);
}

TEST_CASE("objects whose faces lie apart look the same turned and unturned") {
  check_turned_and_unturned(true);
}

TEST_CASE("macro-regions whose boundaries run through shared faces give the whole's picture") {
  for (std::uint64_t seed = 1; seed <= kScenes; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const bool is_turned = seed % 3 != 0;
    OtherWays ways(some_turn_and_move(dice), dice);
    RenderSettings settings = settings_around_origin(dice, 24);
    settings.aovs = {};
    // Two blocks with the faces x = 0 and y = 0 in common, seen along both: the boundaries between
    // the middle columns and rows.
    settings.camera.eye = {0, 0, 6};
    settings.camera.look_at = {0, 0, 0};
    settings.camera.up = {0, 1, 0};
    // Half of the pictures have rays in the boundaries themselves.
    if (dice.one_in(2)) settings.camera.pixel_offset = {0, 1};
    Scene scene = scene_with_settings(is_turned ? moved_settings(settings, ways.map()) : settings,
                                      {mirror_like(), clear_glass(), kMatter[0]});
    for (const double x : {-1.0, 0.0}) {
      for (const double y : {-1.0, 0.0}) {
        const CsgNode block = node_of(BoxShape{{x, y, -0.5}, {x + 1, y + 1, 0.5}});
        add_objects(scene, {is_turned ? ways(block) : block});
      }
    }
    const CsgNode floor = node_of(HalfSpaceShape{{0, 0, 1}, -0.5});
    add_objects(scene, {is_turned ? ways(floor) : floor});
    const Model model = compile_scene(scene);
    const Harvest whole = trace_whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    for (const auto& [columns, rows] : {std::pair{2u, 1u}, {2u, 2u}, {4u, 2u}, {4u, 4u}}) {
      const MacroGrid grid = MacroGrid::regular(frame, columns, rows);
      check_equal(whole, Machine(model, grid).trace(dice), model.settings.image);
    }
  }
}
