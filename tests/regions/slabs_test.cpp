// Macro-regions that are cut in depth, too.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "csg/whole_tree.hpp"
#include "geometry/simd.hpp"
#include "regions/oblique_frame.hpp"
#include "regions/restrict.hpp"
#include "regions/slab_depths.hpp"
#include "topology/node_mesh.hpp"

namespace graycube {
namespace {

using testing::oblique_frame;

using testing::Dice;
using testing::RandomModel;

constexpr ImageSize kImage{40, 24, 1};

struct Shape {
  std::uint32_t columns, rows;
  std::vector<double> depths;
};
const Shape kShapes[] = {
    {1, 1, {3}},      {1, 1, {0.5, 1, 9}},  {2, 1, {4}},       {2, 2, {1.5}},
    {4, 2, {2, 7.5}}, {3, 3, {6, 6.25, 8}}, {4, 4, {5, 7, 9}}, {8, 4, {0.25, 2, 4, 6, 8, 10, 12}}};

template <class Visit>
void for_each_grid(Visit&& visit) {
  for (const auto projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const CameraFrame frame = oblique_frame(projection, kImage);
    for (const Shape& shape : kShapes) {
      INFO(shape.columns << " x " << shape.rows << " x " << shape.depths.size() + 1);
      visit(MacroGrid::regular(frame, shape.columns, shape.rows, shape.depths), frame);
    }
  }
}

template <class Visit>
void for_each_region(const MacroGrid& grid, Visit&& visit) {
  for (std::uint16_t slab = 0; slab < grid.slabs(); ++slab) {
    for (std::uint16_t row = 0; row < grid.rows(); ++row) {
      for (std::uint16_t column = 0; column < grid.columns(); ++column)
        visit(RegionIndex{column, row, slab});
    }
  }
}

std::tuple<int, int, int> key(RegionIndex r) { return {r.column, r.row, r.slab}; }

TEST_CASE("macro-regions with slabs partition space, and all behind the eye is in the first") {
  Dice dice(1);
  for_each_grid([&](const MacroGrid& grid, const CameraFrame& frame) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = frame.eye + dice.point(i % 3 == 0 ? 0.5 : 15);
      const RegionIndex holder = grid.region_of_point(p);
      int holders = 0;
      for_each_region(grid, [&](RegionIndex region) {
        if (!grid.contains(region, p)) return;
        ++holders;
        REQUIRE(region == holder);
      });
      REQUIRE(holders == 1);
      const double depth = dot(frame.forward, p - frame.eye);
      const auto depths = grid.slab_depths();
      REQUIRE(holder.slab == std::ranges::count_if(depths, [&](double d) { return d <= depth; }));
      if (depth < 0) REQUIRE(holder.slab == 0);
    }
  });
}

TEST_CASE("a ray visits each region with slabs once, in the order of its points") {
  Dice dice(2);
  std::size_t across_slabs = 0;
  for_each_grid([&](const MacroGrid& grid, const CameraFrame& frame) {
    for (int i = 0; i < 300; ++i) {
      // Every third ray passes the eye, where all planes of columns and rows meet.
      const Vec3 origin = frame.eye + dice.point(i % 2 == 0 ? 15 : 1);
      Vec3 towards = dice.point(1);
      if (i % 3 == 0) towards = frame.eye - origin;
      const Ray ray{origin, normalized(towards)};
      RegionIndex region = grid.region_of_point(origin);
      std::set<std::tuple<int, int, int>> visited{key(region)};
      double t = 0;
      for (auto exit = grid.exit(region, ray, t);; exit = grid.exit(region, ray, t)) {
        const double end = exit ? exit->t : t + 2;
        REQUIRE(end >= t);
        if (end - t > 1e-6) REQUIRE(grid.region_of_point(ray.at(t + 0.5 * (end - t))) == region);
        if (!exit) break;
        const int steps = (exit->next.column != region.column) + (exit->next.row != region.row) +
                          (exit->next.slab != region.slab);
        REQUIRE(steps == 1);
        if (exit->next.slab != region.slab) {
          ++across_slabs;
          REQUIRE(std::abs(exit->next.slab - region.slab) == 1);
        }
        const auto neighbours = grid.neighbours_of(region);
        REQUIRE(std::ranges::count(neighbours, exit->next) == 1);
        REQUIRE(visited.insert(key(exit->next)).second);
        region = exit->next;
        t = end;
      }
      REQUIRE(region == grid.region_of_point(ray.at(1e9)));
    }
  });
  CHECK(across_slabs > 3000);
}

TEST_CASE("primary rays begin in the first slab and pass the others in order") {
  for_each_grid([&](const MacroGrid& grid, const CameraFrame& frame) {
    for (std::uint32_t i = 0; i < kImage.width * kImage.height; i += 7) {
      const std::uint32_t x = i % kImage.width, y = i / kImage.width;
      const Ray ray = frame.primary_ray(x, y, 0, 0);
      RegionIndex region = grid.region_of_pixel(x, y);
      REQUIRE(region.slab == 0);
      double t = 0;
      for (std::uint32_t slab = 1; slab < grid.slabs(); ++slab) {
        const auto exit = grid.exit(region, ray, t);
        REQUIRE(exit);
        REQUIRE(exit->next ==
                RegionIndex{region.column, region.row, static_cast<std::uint16_t>(slab)});
        REQUIRE(dot(frame.forward, ray.at(exit->t) - frame.eye) ==
                Approx(grid.slab_depths()[slab - 1]));
        region = exit->next;
        t = exit->t;
      }
      REQUIRE_FALSE(grid.exit(region, ray, t));
    }
  });
}

TEST_CASE("a ray that lies in the plane between two slabs is in the farther one") {
  CameraFrame frame;
  frame.image = {32, 32, 1};
  frame.right = {1, 0, 0};
  frame.down = {0, -1, 0};
  frame.forward = {0, 0, 1};
  frame.pixel_size = 0.0625;
  const auto grid = MacroGrid::regular(frame, 1, 1, {2});
  const Ray ray{{-1, 0, 2}, {1, 0, 0}};
  CHECK(grid.region_of_point(ray.origin).slab == 1);
  CHECK_FALSE(grid.exit({0, 0, 1}, ray, 0));
  const auto exit = grid.exit({0, 0, 0}, ray, 0);
  REQUIRE(exit);
  CHECK(exit->t == 0);
  CHECK(exit->next.slab == 1);
  // At the corner of all three planes: columns first, then rows, then slabs.
  const auto corners = MacroGrid::regular(frame, 2, 2, {2});
  const Ray diagonal{{-1, 1, 1}, normalized({1, -1, 1})};
  RegionIndex region = corners.region_of_point(diagonal.origin);
  CHECK(region == RegionIndex{0, 0, 0});
  for (const RegionIndex next : {RegionIndex{1, 0, 0}, {1, 1, 0}, {1, 1, 1}}) {
    const auto step = corners.exit(region, diagonal, 0);
    REQUIRE(step);
    CHECK(step->next == next);
    region = step->next;
  }
}

TEST_CASE("a packet's rays leave regions with slabs as each does by itself") {
  Dice dice(3);
  std::size_t by_slab = 0;
  for_each_grid([&](const MacroGrid& grid, const CameraFrame& frame) {
    for (int i = 0; i < 40; ++i) {
      const RegionIndex region = grid.region_of_point(frame.eye + dice.point(12));
      RayPacket packet;
      for (std::uint64_t n = 1 + dice.below(RayPacket::kSize); n > 0; --n) {
        packet.add({frame.eye + dice.point(12), normalized(dice.point(1))}, dice.one_in(2) ? 0 : 5,
                   dice.one_in(2) ? kInf : 10);
      }
      for (const std::string& name : simd_names()) {
        REQUIRE(choose_simd(name));
        RayPacket shortened = packet;
        std::array<RegionExit, RayPacket::kSize> exits;
        const RayPacket::Mask mask = grid.shorten_to_exits(region, shortened, exits);
        for (std::size_t k = 0; k < packet.count; ++k) {
          const auto exit = grid.exit(region, packet.ray(k), packet.t0[k]);
          const bool leaves = exit && exit->t < packet.t1[k];
          REQUIRE((mask >> k & 1) == leaves);
          if (!leaves) continue;
          REQUIRE(exits[k].t == exit->t);
          REQUIRE(exits[k].next == exit->next);
          by_slab += exit->next.slab != region.slab;
        }
      }
    }
  });
  choose_simd("best");
  CHECK(by_slab > 500);
}

TEST_CASE("every neighbour of a mesh's region is on a linked node") {
  for (std::uint32_t nodes = 1; nodes <= 64; nodes *= 2) {
    for (const MeshMode mode : {MeshMode::k2d, MeshMode::k3d, MeshMode::kRing, MeshMode::kTree}) {
      const NodeMesh mesh(*Hypercube::of_size(nodes), mode);
      std::vector<double> depths;
      for (std::uint32_t slab = 1; slab < mesh.slabs(); ++slab) depths.push_back(slab);
      const MacroGrid grid = MacroGrid::regular(oblique_frame(Projection::kPerspective, kImage),
                                                mesh.columns(), mesh.rows(), depths);
      for_each_region(grid, [&](RegionIndex region) {
        for (const RegionIndex next : grid.neighbours_of(region)) {
          REQUIRE(mesh.cube().link_between(mesh.owner_of(region.column, region.row, region.slab),
                                           mesh.owner_of(next.column, next.row, next.slab)));
        }
      });
    }
  }
}

TEST_CASE("points of a region with slabs have the membership of the whole model") {
  std::size_t compared = 0, inside = 0, dropped = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    const testing::WholeTrees whole(model);
    const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
    for (const std::uint32_t slabs : {2u, 4u}) {
      const MacroGrid grid = MacroGrid::regular(frame, 2, 2, even_slab_depths(model, frame, slabs));
      Dice dice(seed);
      std::vector<Vec3> points;
      for (int i = 0; i < 400; ++i) points.push_back(dice.point(4));
      for_each_region(grid, [&](RegionIndex r) {
        INFO("seed " << seed << ", slab " << r.slab << " of " << slabs);
        const Model part = restrict_to_share(model, grid, only(r, grid));
        const testing::WholeTrees trees(part);
        dropped += model.primitives.size() - part.primitives.size();
        for (const Vec3& p : points) {
          if (!(grid.region_of_point(p) == r)) continue;
          for (std::uint32_t o = 0; o < part.objects.size(); ++o) {
            const std::uint32_t id = part.objects[o].id;
            const bool expected = whole.contains_point(id, p);
            REQUIRE(trees.contains_point(o, p) == expected);
            ++compared;
            inside += expected;
          }
        }
      });
    }
  }
  CHECK(compared > 2000);
  CHECK(inside > 100);
  CHECK(dropped > 500);
}

/// Cubes of side 1 with their middles on the view's line, at these depths.
Model cubes_at(const std::vector<double>& depths) {
  Model model;
  model.delta = 1e-9;
  for (const double z : depths) {
    const auto i = static_cast<std::uint32_t>(model.objects.size());
    Primitive cube;
    cube.bounds = {{-0.5, -0.5, z - 0.5}, {0.5, 0.5, z + 0.5}};
    model.primitives.push_back(cube);
    model.nodes.push_back({TreeNode::Kind::kLeaf, i, 1});
    model.objects.push_back({i, i, 1, cube.bounds});
  }
  return model;
}

CameraFrame frame_at_origin() {
  CameraFrame frame;
  frame.image = kImage;
  frame.right = {1, 0, 0};
  frame.down = {0, -1, 0};
  frame.forward = {0, 0, 1};
  return frame;
}

using Depths = std::vector<double>;

TEST_CASE("even slabs share out the depth between the nearest and the farthest object") {
  const CameraFrame frame = frame_at_origin();
  CHECK(even_slab_depths(cubes_at({2.5, 9.5}), frame, 1).empty());
  CHECK(even_slab_depths(cubes_at({2.5, 9.5}), frame, 4) == Depths{4, 6, 8});
  // What is behind the eye doesn't count, nor does what has no end.
  Model model = cubes_at({-7, 2.5, 9.5, 0});
  model.objects.back().bounds = Aabb::everything();
  CHECK(even_slab_depths(model, frame, 4) == Depths{4, 6, 8});
  CHECK(even_slab_depths(cubes_at({0, 7.5}), frame, 2) == Depths{4});
  CHECK(even_slab_depths(cubes_at({-3}), frame, 4) == Depths{1, 2, 3});
}

TEST_CASE("balanced slabs have equally many primitives") {
  const CameraFrame frame = frame_at_origin();
  CHECK(balanced_slab_depths(cubes_at({9, 1, 2, 3}), frame, 2) == Depths{2.5});
  CHECK(balanced_slab_depths(cubes_at({9, 1, 2, 3}), frame, 4) == Depths{1.5, 2.5, 6});
  // Too few, or too many at one depth: even slabs.
  CHECK(balanced_slab_depths(cubes_at({2.5, 9.5}), frame, 4) == Depths{4, 6, 8});
  CHECK(balanced_slab_depths(cubes_at({1, 1, 1, 1, 1, 9}), frame, 4) ==
        even_slab_depths(cubes_at({1, 9}), frame, 4));
}

TEST_CASE("slabs are ordered whatever the scene, and a grid can be made of them") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Dice dice(seed);
    Depths middles;
    const double reach = std::pow(10.0, dice.between(-12, 12));
    for (std::size_t i = dice.below(12); i > 0; --i) middles.push_back(dice.between(-reach, reach));
    Model model = cubes_at(middles);
    model.delta = 1e-9 * reach;
    const auto slabs = static_cast<std::uint32_t>(1 + dice.below(kMaxSlabs));
    INFO("seed " << seed << ", " << slabs << " slabs");
    for (const auto& depths : {even_slab_depths(model, frame_at_origin(), slabs),
                               balanced_slab_depths(model, frame_at_origin(), slabs)}) {
      REQUIRE(depths.size() + 1 == slabs);
      REQUIRE(MacroGrid::regular(frame_at_origin(), 1, 1, depths).slab_depths() == depths);
    }
  }
}

}  // namespace
}  // namespace graycube
