// Checks by points: a point near a point of a solid lies in the dilated solid, and one near a point
// of the eroded solid lies in the solid.
#include "csg/morphology.hpp"

#include <array>
#include <cmath>

#include "catch.hpp"
#include "csg/kinds.hpp"
#include "csg/random_model.hpp"
#include "csg/tree.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A vector of at most that length, mostly just as long.
Vec3 some_offset(Dice& dice, double most) {
  return (dice.one_in(3) ? dice.between(0, most) : most) *
         (dice.one_in(4) ? dice.axis() : dice.unit_vector());
}

Vec3 point_in(Dice& dice, const Aabb& box) {
  Vec3 p;
  for (int a = 0; a < 3; ++a)
    p[a] = dice.between(std::max(box.lo[a], -6.0), std::min(box.hi[a], 6.0));
  return p;
}

bool is_inside(const Model& model, const Object& object, const Vec3& point) {
  const std::span<const TreeNode> tree{model.nodes.data() + object.first_node, object.node_count};
  return evaluate(
      tree, [&](std::uint32_t p) { return contains(model.primitives[p], model.data(), point); });
}

}  // namespace

TEST_CASE("dilated and eroded primitives enclose and are enclosed") {
  std::array<int, kPrimitiveKinds> dilated_points{}, eroded_points{};
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    RandomModel random(seed);
    Dice& dice = random.dice();
    Scene scene = scene_of({transformed(random.leaf(seed % kLeafKinds), random.map())});
    const Model model = compile_scene(scene);
    if (model.primitives.size() != 1) continue;
    const Primitive& p = model.primitives.front();
    const auto kind = static_cast<std::size_t>(p.kind);
    const double by = dice.one_in(2) ? dice.between(0.01, 0.3) : dice.between(0.3, 3);
    std::vector<Plane> planes;
    const Primitive larger = dilated(p, model.data(), by, planes);
    const auto smaller = eroded(p, model.data(), by, planes);
    INFO("seed " << seed << ", kind " << kind << ", by " << by);
    for (int i = 0; i < 300; ++i) {
      const Vec3 q = point_in(dice, p.bounds);
      const Vec3 near = q + some_offset(dice, by * (1 - 1e-9));
      if (contains(p, model.data(), q)) {
        REQUIRE(contains(larger, {planes, {}}, near));
        REQUIRE(larger.bounds.grown(1e-9).contains(near));
        ++dilated_points[kind];
      }
      if (smaller && contains(*smaller, {planes, {}}, q)) {
        REQUIRE(contains(p, model.data(), near));
        ++eroded_points[kind];
      }
    }
    // The bounds of the larger one hold all points that it holds.
    for (int i = 0; i < 100; ++i) {
      const Vec3 q = dice.point(8);
      if (contains(larger, {planes, {}}, q)) REQUIRE(larger.bounds.grown(1e-9).contains(q));
    }
  }
  for (const csg::KindTraits& kind : csg::kKinds) {
    if (kind.move == nullptr) continue;
    INFO(kind.name);
    CHECK(dilated_points[static_cast<std::size_t>(kind.kind)] > 200);
    CHECK(eroded_points[static_cast<std::size_t>(kind.kind)] > 20);
  }
  CHECK(dilated_points[static_cast<std::size_t>(PrimitiveKind::kMesh)] > 200);
}

TEST_CASE("dilated and eroded scenes enclose and are enclosed, object by object") {
  int dilated_points = 0, eroded_points = 0, full = 0, transparent = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    RandomModel random(seed);
    const Model model = compile_scene(random.scene());
    Dice dice(seed);
    const double by = dice.between(0.01, 0.4);
    const auto same = [&](const Object&) { return by; };
    const auto larger = dilated(model, same);
    const Model smaller = eroded(model, same);
    if (!larger) ++full;
    INFO("seed " << seed << ", by " << by);
    for (int i = 0; i < 400; ++i) {
      const Vec3 q = dice.point(4);
      const Vec3 near = q + some_offset(dice, by * (1 - 1e-9));
      for (const Object& object : model.objects) {
        if (!larger || !is_inside(model, object, q)) continue;
        const auto same_object = [&](const Object& o) { return o.id == object.id; };
        const auto found =
            std::find_if(larger->objects.begin(), larger->objects.end(), same_object);
        REQUIRE(found != larger->objects.end());
        REQUIRE(is_inside(*larger, *found, near));
        REQUIRE(found->bounds.grown(1e-9).contains(near));
        ++dilated_points;
      }
      for (const Object& object : smaller.objects) {
        if (!is_inside(smaller, object, q)) continue;
        const auto found = std::find_if(model.objects.begin(), model.objects.end(),
                                        [&](const Object& o) { return o.id == object.id; });
        REQUIRE(found != model.objects.end());
        REQUIRE(is_inside(model, *found, near));
        REQUIRE(object.bounds.contains(q));
        ++eroded_points;
      }
    }
    for (const Primitive& p : smaller.primitives) {
      if (smaller.materials[p.material].transmit > 0) ++transparent;
    }
  }
  CHECK(dilated_points > 10000);
  CHECK(eroded_points > 1000);
  CHECK(full > 0);
  CHECK(transparent == 0);
}

TEST_CASE("an eroded cone ends at its apex") {
  const Model model = compile_scene(scene_of({node_of(ConeShape{{0, 0, 0}, 2, {0, 0, 2}, 0})}));
  std::vector<Plane> planes;
  const auto smaller = eroded(model.primitives.front(), model.data(), 0.5, planes);
  REQUIRE(smaller);
  CHECK(contains(*smaller, {planes, {}}, {0, 0, 0.6}));
  CHECK_FALSE(contains(*smaller, {planes, {}}, {0, 0, 1.4}));
  CHECK(spans_along(*smaller, {planes, {}}, {{0, 0, -5}, {0, 0, 1}}).interval[0].leave < 6.4);
  CHECK_FALSE(eroded(model.primitives.front(), model.data(), 1.1, planes));
}
