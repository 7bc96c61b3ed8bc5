// Parts that are meant to be apart stay apart: sheets, slits and thin walls just above the rounding
// of numbers, on parts of 100 mm and of 100 m, turned and unturned.
#include <functional>

#include "catch.hpp"
#include "coincidence/pair_rays.hpp"
#include "coincidence/touching_objects.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A function that brings a node to its place.
using Placing = std::function<CsgNode(const CsgNode&)>;

/// A solid of which rays from `from` to within `spread` of `at` first cross one thin piece, or
/// slit, `thickness` thick.
struct ThinPlace {
  CsgNode solid;
  Vec3 from, at;
  double spread = 0;
  double thickness = 0;
  /// Whether it is a slit: then the thin gap lies between the first two pieces of the solid.
  bool is_slit = false;
};

/// Calls `check(size, share, placing, map, dice)` for parts of 100 mm and of 100 m, sheets of 1e-6
/// and 1e-9 of their size.
template <typename Check>
void for_all_sizes(const Check& check) {
  for (const double size : {100.0, 1e5}) {
    for (const double share : {1e-6, 1e-9}) {
      for (std::uint64_t seed = 0; seed < 24; ++seed) {
        INFO("size " << size << ", share " << share << ", seed " << seed);
        Dice dice(seed + 1);
        // Every third part is unturned.
        Chain chain{Move::translate({0, 0, 0})};
        if (seed % 3 != 0) {
          chain = some_turn_and_move(dice);
          chain[1].v = size * chain[1].v;
        }
        const Placing placing = [&](const CsgNode& node) {
          if (seed % 3 == 0) return node;
          return told_anew(node, rewritten(chain, dice, size, 1 + dice.below(4)), dice);
        };
        check(size, share, placing, map_of(chain), dice);
      }
    }
  }
}

/// Checks that both ends of the thin piece are crossed, and as far apart as it is thick.
void check_thin_place(const ThinPlace& place, double size, const Affine& map, Dice& dice) {
  const Model model = compile_scene(scene_of({place.solid}));
  CrossingFinder finder(model);
  std::size_t steep = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 from = map.point(place.from + 0.3 * length(place.from - place.at) * dice.point(1));
    const Vec3 at = map.point(place.at + place.spread * dice.point(1));
    const auto found = finder.all({"", {from, normalized(at - from)}, 0, size, false});
    const std::size_t first = place.is_slit ? 1 : 0;
    REQUIRE(found.size() >= first + 2);
    CHECK(found[first].entering != place.is_slit);
    CHECK(found[first + 1].entering == place.is_slit);
    const double thickness = (found[first + 1].t - found[first].t) * found[first].cosine;
    if (found[first].cosine < 0.5) continue;
    ++steep;
    CHECK(thickness == Approx(place.thickness).epsilon(0.01));
  }
  CHECK(steep > 10);
}

CsgNode cut(CsgNode a, CsgNode b) {
  return operation(Operation::kDifference, {std::move(a), std::move(b)});
}

}  // namespace

TEST_CASE("a floor of a millionth, or a billionth, of a part's size is left by a pocket") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const double w = share * s;
    const CsgNode block = node_of(BoxShape{{0, 0, 0}, {s, s, s}});
    const CsgNode pocket =
        dice.one_in(2)
            ? node_of(BoxShape{{0.2 * s, 0.2 * s, w}, {0.8 * s, 0.8 * s, s}})
            : node_of(CylinderShape{{0.5 * s, 0.5 * s, w}, {0.5 * s, 0.5 * s, s}, 0.3 * s});
    check_thin_place({cut(placing(block), placing(pocket)),
                      {0.5 * s, 0.5 * s, -2 * s},
                      {0.5 * s, 0.5 * s, 0},
                      0.1 * s,
                      w,
                      false},
                     s, map, dice);
  });
}

TEST_CASE("a sheet on a face stays an object of its own, and a slit between two parts stays open") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const double w = share * s, middle = 0.5 * s;
    const CsgNode lower = node_of(BoxShape{{0, 0, 0}, {s, s, middle}});
    const CsgNode upper = node_of(BoxShape{{0, 0, middle + w}, {s, s, s}});
    check_thin_place({operation(Operation::kUnion, {placing(lower), placing(upper)}),
                      {middle, middle, -2 * s},
                      {middle, middle, middle},
                      0.1 * s,
                      w,
                      true},
                     s, map, dice);
    // The sheet lies on the lower part, and is itself crossed by a slit of its own thickness below.
    const CsgNode sheet = node_of(BoxShape{{0, 0, middle + w}, {s, s, middle + 2 * w}});
    check_thin_place({operation(Operation::kUnion, {placing(lower), placing(sheet)}),
                      {middle, middle, 3 * s},
                      {middle, middle, middle},
                      0.1 * s,
                      w,
                      false},
                     s, map, dice);
  });
}

TEST_CASE("plates a billionth of their size thick stay plates, whatever they are made of") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const double w = share * s;
    const Column column(static_cast<ColumnKind>(dice.below(kColumnKinds - 3)), 0, 0, 0.5 * s,
                        {-0.1 * s, 0.1 * s, 0}, dice);
    check_thin_place({placing(column.between(0, w)), {0, 0, -2 * s}, {0, 0, 0}, 0.1 * s, w, false},
                     s, map, dice);
  });
}

TEST_CASE("round walls stay where radii differ by a millionth or a billionth") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const double r = 0.5 * s;
    const auto wall = [&](const CsgNode& outer, const CsgNode& inner) {
      return cut(placing(outer), placing(inner));
    };
    const Vec3 beside{2 * s, 0, 0.1 * s}, at{0, 0, 0};
    const auto ball = [](double radius) { return node_of(SphereShape{{0, 0, 0}, radius}); };
    check_thin_place({wall(ball(r), ball(r * (1 - share))), beside, at, 0.1 * s, r * share, false},
                     s, map, dice);
    const auto rod = [&](double radius, double h) {
      return node_of(CylinderShape{{0, 0, -h}, {0, 0, h}, radius});
    };
    check_thin_place(
        {wall(rod(r, s), rod(r * (1 - share), 1.1 * s)), beside, at, 0.1 * s, r * share, false}, s,
        map, dice);
    const auto egg = [](double radius) {
      return node_of(EllipsoidShape{
          {0, 0, 0}, {Vec3{radius, 0, 0}, {0, 0.8 * radius, 0}, {0, 0, 1.2 * radius}}});
    };
    // At the end of an axis, an ellipsoid's wall is as thick as the difference of the axes.
    check_thin_place(
        {wall(egg(r), egg(r * (1 - share))), {2 * s, 0, 0}, {r, 0, 0}, 1e-3 * s, r * share, false},
        s, map, dice);
    const auto ring = [&](double minor) {
      return node_of(TorusShape{{0, 0, 0}, {0, 0, 1}, r, minor});
    };
    check_thin_place({wall(ring(0.3 * r), ring(0.3 * r * (1 - share))),
                      {2 * s, 0, 0.05 * s},
                      {1.3 * r, 0, 0},
                      0.02 * s,
                      0.3 * r * share,
                      false},
                     s, map, dice);
  });
}

TEST_CASE("cylinders whose axes lie a millionth or a billionth apart leave a crescent") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const double r = 0.5 * s, w = share * s;
    const CsgNode rod = node_of(CylinderShape{{0, 0, -s}, {0, 0, s}, r});
    const CsgNode aside = node_of(CylinderShape{{-w, 0, -1.1 * s}, {-w, 0, 1.1 * s}, r});
    check_thin_place(
        {cut(placing(rod), placing(aside)), {2 * s, 0, 0}, {r, 0, 0}, 1e-3 * s, w, false}, s, map,
        dice);
  });
}

TEST_CASE("a wedge stays whose faces form an angle of a millionth or a billionth") {
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    const CsgNode block = node_of(BoxShape{{0, 0, 0}, {s, s, s}});
    // The part above the plane z = share · x is taken away.
    const CsgNode above = node_of(HalfSpaceShape{{share, 0, -1}, 0});
    check_thin_place({cut(placing(block), placing(above)),
                      {0.8 * s, 0.5 * s, -2 * s},
                      {0.8 * s, 0.5 * s, 0},
                      1e-3 * s,
                      0.8 * share * s,
                      false},
                     s, map, dice);
  });
}

TEST_CASE("a pack of sheets a billionth thick, and apart, stays as many sheets") {
  constexpr std::size_t kSheets = 25;
  for_all_sizes([](double s, double share, const Placing& placing, const Affine& map, Dice& dice) {
    std::vector<CsgNode> sheets;
    for (std::size_t i = 0; i < kSheets; ++i) {
      const double z = 2 * share * s * static_cast<double>(i);
      sheets.push_back(placing(node_of(BoxShape{{0, 0, z}, {s, s, z + share * s}})));
    }
    const Model model = compile_scene(scene_of({operation(Operation::kUnion, std::move(sheets))}));
    CrossingFinder finder(model);
    for (int i = 0; i < 10; ++i) {
      const Vec3 from = map.point({0.5 * s, 0.5 * s, 2 * s}),
                 at = map.point(s * Vec3{dice.between(0.3, 0.7), 0.5, 0});
      CHECK(finder.all({"", {from, normalized(at - from)}, 0, s, false}).size() == 2 * kSheets);
    }
  });
}

TEST_CASE(
    "planes of other parts, each within rounding of the next, don't bring the sides of a sheet "
    "together") {
  // The sides are 1e-11 of the size apart, a thousand times the rounding of numbers; 4000 steps lie
  // between.
  constexpr std::size_t kSteps = 4000;
  for (const bool is_turned : {false, true}) {
    Dice dice(is_turned ? 1 : 2);
    const double s = 100, w = 1e-11 * s;
    OtherWays ways(some_turn_and_move(dice), dice);
    const auto placing = [&](const CsgNode& node) { return is_turned ? ways(node) : node; };
    std::vector<CsgNode> solids{placing(node_of(BoxShape{{0, 0, 0}, {s, s, w}}))};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double z = w * static_cast<double>(i) / kSteps, x = 2 * s + static_cast<double>(i);
      solids.push_back(placing(node_of(BoxShape{{x, 0, -s}, {x + 0.5, s, z}})));
    }
    const Model model = compile_scene(scene_of(std::move(solids)));
    CrossingFinder finder(model);
    const Affine map = is_turned ? ways.map() : Affine{};
    for (int i = 0; i < 20; ++i) {
      const Vec3 from = map.point({0.5 * s, 0.5 * s, 2 * s}),
                 at = map.point(s * Vec3{dice.between(0.3, 0.7), 0.5, 0});
      const auto found = finder.all({"", {from, normalized(at - from)}, 0, s, false});
      REQUIRE(found.size() == 2);
      CHECK((found[1].t - found[0].t) * found[0].cosine == Approx(w).epsilon(0.05));
    }
  }
}
