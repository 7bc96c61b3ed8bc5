// Scenes made from numbers of six significant digits, as OpenSCAD's trees have: what was flush
// before they were rounded stays flush, and what was not stays apart.
#include <string>

#include "catch.hpp"
#include "coincidence/pair_models.hpp"
#include "coincidence/six_digits.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The rounding of sums of some numbers of six digits, relative to their size.
constexpr double kSixDigits = 5e-6;

/// Pairs whose flush scene is written in six digits. `told(node, chain)` tells its parts.
template <typename Told>
void check_six_digits(std::uint64_t count, const std::vector<PairKind>& kinds,
                      std::size_t most_moves, const Told& told, bool forgives_skins = false) {
  Tally sum;
  std::size_t wrong_pairs = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    PairOptions options{.turns = ChainOptions::Turns::kRigid, .is_any_size = false};
    options.most_moves = most_moves;
    Dice dice(seed);
    options.telling = [&](const CsgNode& node, const Chain& chain) {
      return told(node, chain, dice);
    };
    FlushPair pair = PairMaker(seed, kinds[seed % kinds.size()], options).make();
    round_to_six_digits(pair.flush);
    const Tally tally =
        PairOfModels(pair, {.forgives_skins = forgives_skins, .rounding = kSixDigits}).compare(100);
    sum.add(tally);
    wrong_pairs += tally.wrong > 0 ? 1 : 0;
  }
  INFO(sum.wrong << " of " << sum.rays << " rays, " << sum.near_edges << " more near edges; "
                 << wrong_pairs << " pairs of " << count << "; first: " << sum.first);
  // If a ray grazes a face, a rounded plane may be met a little beyond an edge.
  CHECK(sum.wrong * 10'000 <= sum.rays);
  CHECK(sum.met * 3 > sum.rays);
  CHECK(sum.near_edges * 20 <= sum.rays);
}

/// All kinds whose touching faces are plane, whatever the parts are.
const std::vector<PairKind> kFlatKinds{PairKind::kThroughHoles, PairKind::kPocketToTop,
                                       PairKind::kNotch, PairKind::kStandingBoss,
                                       PairKind::kComplements};
/// All kinds but assemblies, whose parts lie many times their size from the origin.
std::vector<PairKind> all_kinds() {
  std::vector<PairKind> kinds;
  for (std::size_t i = 0; i + 1 < kPairKinds; ++i) kinds.push_back(static_cast<PairKind>(i));
  return kinds;
}

CsgNode as_openscad(const CsgNode& node, const Chain& chain, Dice&) {
  return on_own_levels(AsOpenscad()(node), chain);
}
CsgNode by_other_ways(const CsgNode& node, const Chain& chain, Dice& dice) {
  return on_own_levels(AsOpenscad()(node), rewritten(chain, dice, 1, 1));
}

}  // namespace

TEST_CASE("pairs in six digits hold the same solids but for skins") {
  check_six_digits(500, all_kinds(), 2, by_other_ways, true);
}

TEST_CASE("cuts flush in numbers that six digits round stay flush under the turns of their tree") {
  check_six_digits(500, kFlatKinds, 3, as_openscad);
}

TEST_CASE("cuts flush in numbers that six digits round stay flush under turns of their own") {
  check_six_digits(500, kFlatKinds, 2, by_other_ways);
}

TEST_CASE("round surfaces that coincide stay one in six digits") {
  check_six_digits(500, all_kinds(), 2, as_openscad);
}

namespace {

/// A box in inches, and a pocket that leaves a floor of so many 64ths of an inch; millimetres in
/// six digits.
Scene inch_box(double floor_64ths, std::size_t across) {
  constexpr double kInch = 25.4;
  const double floor = floor_64ths / 64 * kInch;
  const double a = static_cast<double>(across) * kInch;
  const CsgNode box = node_of(BoxShape{{}, {a, a, kInch}});
  const CsgNode pocket =
      AsOpenscad::with_level(node_of(BoxShape{{}, {0.8 * a, 0.8 * a, kInch - floor}}),
                             translation({0.1 * a, 0.1 * a, floor}));
  Scene scene = scene_of({operation(Operation::kDifference, {box, pocket})});
  scene.objects.front().csg =
      AsOpenscad::with_level(scene.objects.front().csg, rotation({1, 2, 3}, 25));
  round_to_six_digits(scene);
  return scene;
}

}  // namespace

TEST_CASE(
    "a pocket in inches is open, and its floor of some 64ths of an inch is left, in six digits") {
  for (const std::size_t across : {1u, 4u, 12u, 40u}) {
    for (double floor = 1; floor <= 60; floor += 1) {
      INFO(across << " inches across, floor of " << floor << "/64 in");
      const Scene scene = inch_box(floor, across);
      const Model model = compile_scene(scene);
      CrossingFinder finder(model);
      const Affine map = rotation({1, 2, 3}, 25);
      const double a = static_cast<double>(across) * 25.4;
      for (const double x : {0.2, 0.45, 0.7}) {
        const Ray ray{map.point({x * a, 0.4 * a, 3 * 25.4}), map.vector({0, 0, -1})};
        const auto found = finder.all({"", {ray.origin, normalized(ray.direction)}, 0, a, false});
        REQUIRE(found.size() == 2);
        CHECK(found[1].t - found[0].t == Approx(floor / 64 * 25.4).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("in six digits a turned part of 40 mm that is 57 m away keeps a floor of 0.02 mm") {
  constexpr double kFloor = 0.02, kHeight = 8;
  Dice dice(1);
  for (int i = 0; i < 24; ++i) {
    const Affine turned = rotation(dice.unit_vector(), dice.between(0, 180));
    // These numbers have six digits.
    const Affine away = translation({12345.6, -54321.7, 9876.5});
    const CsgNode plate = node_of(BoxShape{{0, 0, 0}, {40, 30, kHeight}});
    const CsgNode slot = node_of(BoxShape{{20, -1, kFloor}, {30, 31, kHeight + 1}});
    Scene scene = scene_of(
        {transformed(transformed(operation(Operation::kDifference, {plate, slot}), turned), away)});
    scene.digits = 6;
    const Model model = compile_scene(scene);
    CrossingFinder finder(model);
    const Affine map = compose(away, turned);
    const Ray ray{map.point({25, 15, 20}), normalized(map.vector({0, 0, -1}))};
    const auto found = finder.all({"", ray, 0, 40, false});
    REQUIRE(found.size() == 2);
    // The 57 m, known to half a millimetre, move all faces alike.
    CHECK(found[1].t - found[0].t == Approx(kFloor).margin(1e-3));
  }
}

TEST_CASE("pegs with ends of slender triangles cut flush holes, in the 24 bits of a file") {
  constexpr double kHeight = 6.35;
  const auto in_24_bits = [](double v) { return static_cast<double>(static_cast<float>(v)); };
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const auto sides = static_cast<std::uint32_t>(16 + dice.below(120));
    TriangleMesh drum = closed(drum_polygons(3.65, 0, kHeight, sides));
    for (Vec3& p : drum.points) p = {in_24_bits(p.x), in_24_bits(p.y), in_24_bits(p.z)};
    const CsgNode peg = node_of(MeshShape{std::move(drum), 7});
    const Affine to_middle = translation({20, 10, 0});
    const Affine map =
        compose(translation(dice.point(100)), rotation(dice.unit_vector(), dice.between(0, 180)));
    const CsgNode plate = node_of(BoxShape{{0, 0, 0}, {40, 20, kHeight}});
    Scene scene = scene_of({transformed(
        operation(Operation::kDifference, {plate, transformed(peg, to_middle)}), map)});
    scene.digits = 6;
    const Model model = compile_scene(scene);
    CrossingFinder finder(model);
    for (int i = 0; i < 40; ++i) {
      const double x = 20 + dice.between(-2, 2), y = 10 + dice.between(-2, 2);
      const Vec3 from = map.point({x, y, 30}), to = map.point({x, y, -30});
      CHECK(finder.all({"", {from, normalized(to - from)}, 0, 40, false}).empty());
    }
  }
}
