// The walk through the leaf regions against the whole trees: bit for bit.
#include "subdivisions/linked_walk.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "crossings/against_whole_trees.hpp"
#include "subdivisions/linked_cells.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// All crossings that the walk meets, region by region.
std::vector<WholeCrossing> walked(const LinkedCells& cells, const RayCase& c, Mailbox& mailbox) {
  std::vector<WholeCrossing> all;
  mailbox.begin_ray();
  cells.walk(c.ray, c.t0, c.t1, mailbox, [&](const CellPiece& piece, double from, double to) {
    const std::size_t first = all.size();
    for (std::uint32_t i = 0; i < piece.count(); ++i) {
      piece.for_each_crossing(i, from, to, [&](const Crossing& x) {
        all.push_back(plain(x));
        return true;
      });
    }
    std::stable_sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t; });
    return true;
  });
  return all;
}

const std::vector<BspOptions> kOptions{{},
                                       {.step_cost = 0.01, .max_depth = 48},
                                       {.step_cost = 0.6, .max_depth = 9},
                                       {.step_cost = 8, .max_depth = 48}};

}  // namespace

TEST_CASE("the walk gives bit for bit the crossings of the whole trees") {
  std::vector<WalkingSearch<LinkedCells>> searches;
  Mailbox mailbox;
  const auto prepare = [&](const Model& model) {
    searches.clear();
    std::vector<SplitPlane> planes;
    for (const BspOptions& o : kOptions) {
      searches.emplace_back(LinkedCells(model, Entry::kDescent, o));
      add_planes(searches.back().cells().bsp(), planes);
    }
    return planes;
  };
  compare_families(1000, prepare, [&](const Model& model, const RayCase& c, const auto& expected) {
    return std::all_of(searches.begin(), searches.end(), [&](const auto& search) {
      const auto all = walked(search.cells(), c, mailbox);
      if (all != expected) {
        UNSCOPED_INFO("crossings expected:" << describe(expected) << "\nwalked:" << describe(all));
        return false;
      }
      return agrees(
          model, c, expected,
          [&](double t0, double t1) { return search.first_crossing(c.ray, t0, t1, mailbox); },
          [&](double t0, double t1, Rgb& light) {
            return search.pass_light(c.ray, t0, t1, mailbox, light);
          });
    });
  });
}

TEST_CASE(
    "a surface that grazes a plane of the subdivision is found on whichever side its root falls") {
  // An ellipsoid ends a few bits before the plane that its neighbour brings about. Rays almost in
  // that plane meet its pole: which region their roots lie in is decided by rounding, so both
  // regions must know it. Regions that aren't grown fail here.
  const double bit = std::ldexp(1, -52);
  int scenes = 0, crossed = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Dice dice(seed);
    const Vec3 center = dice.point(0.3);
    const Affine axes = rotation(dice.unit_vector(), dice.between(0, 360));
    const auto scene_with = [&](double lo) {
      return scene_of({node_of(EllipsoidShape{
                           center, {0.7 * axes.row(0), 0.5 * axes.row(1), 0.3 * axes.row(2)}}),
                       node_of(SphereShape{center, 0.1}),
                       node_of(BoxShape{{lo, -1, -1}, {3, 1, 1}})});
    };
    const Model apart = compile_scene(scene_with(2));
    // The builder puts its plane 4 δ before the box.
    const double end = apart.primitives[0].bounds.hi.x,
                 plane = end + static_cast<double>(1 + dice.below(4)) * bit;
    double lo = plane + 4 * apart.delta;
    while (lo - 4 * apart.delta < plane) lo = std::nextafter(lo, 2.0);
    const Scene scene = scene_with(lo);
    const Model model = compile_scene(scene);
    const WholeTrees trees(model, scene);
    const LinkedCells cells(model);
    const Bsp& bsp = cells.bsp();
    const bool has_plane = std::any_of(
        bsp.nodes().begin(), bsp.nodes().end(),
        [&](const BspNode& n) { return n.axis == 0 && std::fabs(n.split - plane) < 4 * bit; });
    if (!has_plane) continue;  // another plane was as good
    ++scenes;
    // The surface's point with the largest x: centre + A Aᵀ x / |Aᵀ x|, A's columns being the axes.
    const Vec3 row{0.7 * axes.row(0).x, 0.5 * axes.row(1).x, 0.3 * axes.row(2).x};
    const Vec3 pole =
        center + (1 / length(row)) * (0.7 * row.x * axes.row(0) + 0.5 * row.y * axes.row(1) +
                                      0.3 * row.z * axes.row(2));
    Mailbox mailbox;
    for (int i = 0; i < 500; ++i) {
      const auto some_bits = [&](std::size_t n) {
        return static_cast<double>(dice.below(2 * n + 1)) - static_cast<double>(n);
      };
      const double angle = dice.between(0, 360);
      Vec3 d = rotation({1, 0, 0}, angle).vector({0, 1, 0});
      d.x = some_bits(8) * bit / 4;
      Vec3 o = pole - d;
      o.x = end + some_bits(8) * bit / 4;
      const RayCase c{"almost in the plane", {o, d}};
      const auto expected = trees.crossings_between(c.ray, c.t0, c.t1);
      crossed += expected.empty() ? 0 : 1;
      if (walked(cells, c, mailbox) != expected) FAIL(describe(seed, c));
    }
  }
  CHECK(scenes > 20);
  CHECK(crossed > 100 * scenes);
}
