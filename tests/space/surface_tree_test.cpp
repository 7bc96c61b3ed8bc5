// The hierarchy over surfaces against the whole trees: bit for bit.
#include "space/surface_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "against_whole_trees.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// From all objects cut into cells to none.
const std::vector<SurfaceTreeOptions> kOptions{{},
                                               {.whole_object_literals = 0},
                                               {.whole_object_literals = 2},
                                               {.whole_object_literals = 100000}};

}  // namespace

TEST_CASE("the surface tree gives bit for bit the crossings of the whole trees") {
  std::vector<SurfaceTree> trees;
  TreeScratch scratch;
  const auto prepare = [&](const Model& model) {
    trees.clear();
    for (const SurfaceTreeOptions& o : kOptions) trees.push_back(SurfaceTree::build(model, o));
    std::vector<SplitPlane> planes;
    for (std::uint32_t o = 0; o < model.objects.size(); ++o)
      add_planes(Bsp::build_for_object(model, o), planes);
    return planes;
  };
  compare_families(1000, prepare, [&](const Model& model, const RayCase& c, const auto& expected) {
    if (c.t0 < 0) return true;  // no ray of a picture looks back
    return std::all_of(trees.begin(), trees.end(), [&](const SurfaceTree& tree) {
      return agrees(
          model, c, expected,
          [&](double t0, double t1) { return tree.first_crossing(c.ray, t0, t1, scratch); },
          [&](double t0, double t1, Rgb& light) {
            return tree.pass_light(c.ray, t0, t1, scratch, light);
          });
    });
  });
}

TEST_CASE(
    "a solid that the ray misses is not what it hits, though a plane of it has the same "
    "parameter") {
  // Once the ends of the missed box's empty interval counted as its crossings.
  const CsgNode missed = node_of(BoxShape{{0, 2, -1}, {1, 3, 1}}),
                met = node_of(BoxShape{{1, 2, -1}, {5, 4, 1}});
  const Ray ray{{0, 0, 0}, normalized(Vec3{1, 1, 0})};  // crosses y = 2 at x = 2
  const CsgNode rest = operation(Operation::kComplement, {missed});
  for (const CsgNode& solid : {operation(Operation::kUnion, {missed, met}),
                               operation(Operation::kIntersection, {rest, met}),
                               operation(Operation::kDifference, {met, missed})}) {
    const Model model = compile_scene(scene_of({solid}));
    TreeScratch scratch;
    const auto hit = SurfaceTree::build(model).first_crossing(ray, 0, Aabb::kInf, scratch);
    REQUIRE(hit);
    CHECK(hit->t == Approx(2 * std::sqrt(2.0)));
    CHECK(model.primitives[hit->primitive].v[3] == 5);
  }
}

TEST_CASE("a tree of one item and a tree of thousands find the same") {
  RandomModel random(9, {.coincidences = false, .unbounded = false});
  std::vector<CsgNode> small;
  for (int i = 0; i < 3000; ++i) {
    CsgNode leaf = random.leaf(random.dice().below(kLeafKinds - 1));
    small.push_back(transformed(transformed(leaf, scaling({0.05, 0.05, 0.05})),
                                translation(random.dice().point(4))));
  }
  const Model apart = compile_scene(scene_of(small));
  const Model united = compile_scene(scene_of({operation(Operation::kUnion, small)}));
  const SurfaceTree many = SurfaceTree::build(apart), one = SurfaceTree::build(united);
  TreeScratch scratch;
  std::size_t hits = 0;
  for (int i = 0; i < 3000; ++i) {
    // From outside all of them, so that the nearest surface is the union's.
    const Vec3 from = 9.0 * random.dice().unit_vector();
    const Ray ray{from, normalized(random.dice().point(3) - from)};
    const auto a = many.first_crossing(ray, 0, Aabb::kInf, scratch);
    const auto b = one.first_crossing(ray, 0, Aabb::kInf, scratch);
    INFO("ray " << i);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) continue;
    ++hits;
    REQUIRE(a->t == b->t);
    REQUIRE(a->primitive == b->primitive);
  }
  CHECK(hits > 100);
}
