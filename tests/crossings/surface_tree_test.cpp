// The hierarchy over surfaces against the whole trees: bit for bit.
#include "crossings/surface_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "against_whole_trees.hpp"
#include "catch.hpp"
#include "geometry/simd.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Options with which all objects are cut into cells, some, or none.
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
    const auto hit = SurfaceTree::build(model).first_crossing(ray, 0, kInf, scratch);
    REQUIRE(hit);
    CHECK(hit->t == Approx(2 * std::sqrt(2.0)));
    CHECK(csg::sphere_radius(model.primitives[hit->primitive].v) == 5);
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
    // The ray starts outside all of them, so that the nearest surface is the union's.
    const Vec3 from = 9.0 * random.dice().unit_vector();
    const Ray ray{from, normalized(random.dice().point(3) - from)};
    const auto a = many.first_crossing(ray, 0, kInf, scratch);
    const auto b = one.first_crossing(ray, 0, kInf, scratch);
    INFO("ray " << i);
    REQUIRE(a.has_value() == b.has_value());
    if (!a) continue;
    ++hits;
    REQUIRE(a->t == b->t);
    REQUIRE(a->primitive == b->primitive);
  }
  CHECK(hits > 100);
}

namespace {

/// A packet of rays of which many go the same way, and what each of them finds alone.
struct PacketCase {
  RayPacket packet;
  std::array<std::optional<Crossing>, RayPacket::kSize> expected;
  std::array<std::optional<Rgb>, RayPacket::kSize> light;
};

constexpr Rgb kStart{0.9, 0.7, 0.3};

PacketCase packet_case(const SurfaceTree& tree, RandomRays& maker, TreeScratch& scratch) {
  PacketCase c;
  Dice& dice = maker.dice();
  const std::size_t count = dice.one_in(4) ? 1 + dice.below(RayPacket::kSize) : RayPacket::kSize;
  const std::uint64_t spread = dice.below(3);  // one kind of ray; side by side; anything
  RayCase ray = maker.make(dice.below(kRayCases));
  for (std::size_t i = 0; i < count; ++i) {
    if (spread == 2) ray = maker.make(dice.below(kRayCases));
    if (spread == 1) {
      ray.ray.origin = ray.ray.origin + 0.05 * dice.point(1);
      ray.ray.direction = normalized(ray.ray.direction + 0.05 * dice.point(1));
    }
    const double t0 = std::fmax(0.0, ray.t0);
    c.packet.add(ray.ray, t0, ray.t1);
    c.expected[i] = tree.first_crossing(ray.ray, t0, ray.t1, scratch);
    Rgb light = kStart;
    if (tree.pass_light(ray.ray, t0, ray.t1, scratch, light)) c.light[i] = light;
  }
  return c;
}

bool finds_the_same(const SurfaceTree& tree, const PacketCase& c, TreeScratch& scratch) {
  std::array<Crossing, RayPacket::kSize> found;
  const RayPacket::Mask hits = tree.first_crossings(c.packet, scratch, found);
  std::array<Rgb, RayPacket::kSize> light;
  light.fill(kStart);
  const RayPacket::Mask passed = tree.pass_lights(c.packet, scratch, light);
  for (std::size_t i = 0; i < c.packet.count; ++i) {
    if (((hits >> i & 1) != 0) != c.expected[i].has_value()) return false;
    if (c.expected[i] && !(plain(found[i]) == plain(*c.expected[i]))) return false;
    if (((passed >> i & 1) != 0) != c.light[i].has_value()) return false;
    if (c.light[i] && !(light[i] == *c.light[i])) return false;
  }
  return hits >> c.packet.count == 0 && passed >> c.packet.count == 0;
}

}  // namespace

TEST_CASE("a packet finds bit for bit what its rays find alone, with every instruction set") {
  const std::vector<std::string> simd = simd_names();
  REQUIRE(!simd.empty());
  std::size_t hits = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const SceneFamily& family = kFamilies[seed % kFamilies.size()];
    const Model model = compile_scene(RandomModel(seed, family.options).scene());
    const SurfaceTree tree = SurfaceTree::build(model, kOptions[seed / 4 % kOptions.size()]);
    RandomRays maker(seed, model);
    TreeScratch scratch;
    for (int i = 0; i < 60; ++i) {
      const PacketCase c = packet_case(tree, maker, scratch);
      for (const auto& hit : c.expected) hits += hit ? 1 : 0;
      for (const std::string& name : simd) {
        REQUIRE(choose_simd(name));
        INFO("seed " << seed << ", packet " << i << ", " << name);
        REQUIRE(finds_the_same(tree, c, scratch));
      }
      choose_simd("best");
    }
  }
  CHECK(hits > 50000);
}

TEST_CASE(
    "a packet finds in a mesh of many triangles what its rays find alone, also behind faces that "
    "cancel") {
  PolygonMesh polygons = ball_polygons(2, 20, 30);
  // A box and its inside-out twin leave nothing, wherever they are.
  for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{1.5, -1, 0.5}, Vec3{-3, -3, -3}}) {
    append(polygons, box_polygons(at, at + Vec3{3, 3, 3}));
    append(polygons, box_polygons(at, at + Vec3{3, 3, 3}), true);
  }
  const TriangleMesh mesh = closed(polygons);
  const CsgNode floor = node_of(HalfSpaceShape{{0, 0, 1}, -2.5});
  std::size_t hits = 0;
  for (const double transmit : {0.0, 0.5}) {
    Scene scene = scene_of({node_of(MeshShape{mesh}), floor});
    scene.materials.front().material.transmit = transmit;
    const Model model = compile_scene(scene);
    const SurfaceTree tree = SurfaceTree::build(model);
    RandomRays maker(7, model);
    TreeScratch scratch;
    for (int i = 0; i < 1000; ++i) {
      const PacketCase c = packet_case(tree, maker, scratch);
      for (const auto& hit : c.expected) hits += hit && hit->object == 0 ? 1 : 0;
      for (const std::string& name : simd_names()) {
        REQUIRE(choose_simd(name));
        INFO("packet " << i << ", " << name);
        REQUIRE(finds_the_same(tree, c, scratch));
      }
      choose_simd("best");
    }
  }
  CHECK(hits > 2000);
}

TEST_CASE("an instruction set is chosen by name, and unknown ones are refused") {
  CHECK(simd_names().front() == "scalar");
  CHECK_FALSE(choose_simd("mmx"));
  CHECK(choose_simd("scalar"));
  CHECK(choose_simd("best"));
}

namespace {

std::size_t depth_below(const SurfaceTree& tree, std::uint32_t node) {
  std::size_t deepest = 0;
  for (const std::uint32_t child : tree.nodes()[node].child) {
    if (child == 0 || (child & WideNode::kItemFlag) != 0) continue;
    deepest = std::max(deepest, depth_below(tree, child));
  }
  return 1 + deepest;
}

}  // namespace

TEST_CASE("items whose sizes grow without end don't make the tree deeper than the walk's stack") {
  std::vector<CsgNode> spheres;
  // As far as a scene's range reaches.
  for (double size = 5e-18; size < 3e17; size *= 1.2) {
    spheres.push_back(node_of(SphereShape{{3 * size, 0, 0}, 0.2 * size}));
  }
  const Model model = compile_scene(scene_of(spheres));
  const SurfaceTree tree = SurfaceTree::build(model);
  CHECK(depth_below(tree, 0) > 20);
  CHECK(depth_below(tree, 0) <= SurfaceTree::kMaxDepth);
  TreeScratch scratch;
  for (const Primitive& p : model.primitives) {
    const double r = csg::sphere_radius(p.v);
    const Ray ray{Vec3{csg::sphere_center(p.v).x, 0, 3 * r}, {0, 0, -1}};
    const auto hit = tree.first_crossing(ray, 0, 2.5 * r, scratch);
    REQUIRE(hit);
    CHECK(hit->t == Approx(2 * r));
  }
}
