// Foreign bounds tell where objects may be that a node does not hold: they must never say that a
// way is free if something foreign crosses it.
#include "visibility/foreign_bounds.hpp"

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "geometry/simd.hpp"
#include "regions/camera.hpp"
#include "regions/macro_grid.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Model bounded_model(std::uint64_t seed) {
  RandomOptions options;
  options.unbounded = false;
  return compile_scene(RandomModel(seed, options).scene());
}

ModelContents some_contents(const Model& model, Dice& dice) {
  const CameraFrame frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid = MacroGrid::regular(frame, 4, 2);
  const RegionShare share{4, 2, static_cast<std::uint32_t>(dice.below(4)),
                          static_cast<std::uint32_t>(dice.below(2))};
  ModelContents contents = contents_of_share(model, grid, share);
  std::vector<bool> chosen(model.objects.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = dice.one_in(2);
  contents.hold_whole(chosen);
  return contents;
}

/// The objects that are not held whole, as in the whole scene; and the parts that are held.
struct Foreign {
  Model outside, parts;
  Foreign(const Model& model, const ModelContents& contents) {
    std::vector<bool> others(contents.is_whole);
    others.flip();
    outside = extract(model, {others, {}});
    parts = extract(model, {std::vector<bool>(model.objects.size()), contents.parts});
  }
};

RayPacket some_rays(Dice& dice) {
  RayPacket packet;
  const Vec3 from = dice.point(4);
  const Vec3 towards = dice.one_in(4) ? dice.unit_vector() : normalized(-from);
  const double spread = dice.one_in(2) ? 0.1 : 2.0;
  for (std::uint64_t count = 1 + dice.below(RayPacket::kSize); packet.count < count;) {
    const double t0 = dice.one_in(2) ? 0 : dice.between(0, 5);
    const Vec3 origin = from + spread * dice.point(1);
    packet.add({origin, normalized(towards + spread * dice.point(0.9))}, t0,
               dice.one_in(3) ? kInf : t0 + dice.between(0, 8));
  }
  return packet;
}

}  // namespace

TEST_CASE(
    "a way that foreign bounds call free is crossed by nothing foreign, nor by the parts that are "
    "held, with vectors of any width") {
  const std::vector<std::string> widths = simd_names();
  std::uint64_t free = 0, met = 0, crossed = 0, crossed_parts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const std::string& width = widths[seed % widths.size()];
    INFO("seed " << seed << ", " << width);
    REQUIRE(choose_simd(width));
    Dice dice(seed);
    const Model model = bounded_model(seed);
    // Few literals make an object of cells, of which there are then several items.
    const SurfaceTree whole = SurfaceTree::build(
        model, {.whole_object_literals = static_cast<std::uint32_t>(dice.below(9))});
    const ModelContents contents = some_contents(model, dice);
    const std::size_t most_bytes = dice.one_in(2) ? std::size_t{1} << 20 : dice.below(2000);
    const auto bounds = ForeignBoundsMaker(whole).bounds(contents, most_bytes);
    REQUIRE(bounds);
    REQUIRE(bounds->memory_bytes() <= std::max(most_bytes, sizeof(WideNode)));
    const Foreign foreign(model, contents);
    const SurfaceTree outside = SurfaceTree::build(foreign.outside),
                      parts = SurfaceTree::build(foreign.parts);
    TreeScratch scratch, scratch_of_parts, scratch_of_bounds;
    for (int i = 0; i < 40; ++i) {
      const RayPacket packet = some_rays(dice);
      const RayPacket::Mask mask = bounds->may_meet(packet, scratch_of_bounds);
      for (std::size_t r = 0; r < packet.count; ++r) {
        const bool is_crossed =
            outside.first_crossing(packet.ray(r), packet.t0[r], packet.t1[r], scratch).has_value();
        const bool is_crossed_by_part =
            parts.first_crossing(packet.ray(r), packet.t0[r], packet.t1[r], scratch_of_parts)
                .has_value();
        const bool may_meet = (mask >> r & 1) != 0;
        REQUIRE((may_meet || (!is_crossed && !is_crossed_by_part)));
        ++(may_meet ? met : free);
        crossed += is_crossed ? 1 : 0;
        crossed_parts += is_crossed_by_part ? 1 : 0;
      }
      REQUIRE((mask & ~packet.all()) == 0);
    }
  }
  REQUIRE(choose_simd("best"));
  CHECK(free > met / 4);
  CHECK(crossed > 5000);
  CHECK(crossed_parts > 100);
}

TEST_CASE("of an object held in part all within its bounds is foreign, wherever its surfaces are") {
  std::uint64_t parts = 0, empty_corners = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    const Model model = bounded_model(seed);
    const SurfaceTree whole = SurfaceTree::build(model, {.whole_object_literals = 0});
    const ForeignBoundsMaker maker(whole);
    TreeScratch scratch;
    const ModelContents contents = some_contents(model, dice);
    const auto with = maker.bounds(contents, dice.one_in(2) ? std::size_t{1} << 20 : 0),
               without = maker.bounds({contents.is_whole, {}}, 1 << 20);
    REQUIRE((with && without));
    for (const ModelContents::Part& part : contents.parts) {
      const Aabb& box = model.objects[part.object].bounds;
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 p;
        for (int a = 0; a < 3; ++a) p[a] = (corner >> a & 1) != 0 ? box.hi[a] : box.lo[a];
        RayPacket at_corner;
        at_corner.add({p - Vec3{1, 0, 0}, {1, 0, 0}}, 1, 1);
        REQUIRE(with->may_meet(at_corner, scratch) == 1);
        empty_corners += without->may_meet(at_corner, scratch) == 0 ? 1 : 0;
      }
      ++parts;
    }
  }
  CHECK(parts > 60);
  CHECK(empty_corners > 20);
}

TEST_CASE("who holds everything has nothing foreign") {
  const Model model = bounded_model(3);
  const SurfaceTree whole = SurfaceTree::build(model);
  const auto bounds = ForeignBoundsMaker(whole).bounds(
      {std::vector<bool>(model.objects.size(), true), {}}, 1 << 20);
  REQUIRE(bounds);
  CHECK(bounds->nodes().empty());
  Dice dice(1);
  TreeScratch scratch;
  CHECK(bounds->may_meet(some_rays(dice), scratch) == 0);
}

TEST_CASE("where something foreign has no bounds nothing can be said") {
  Scene scene =
      scene_of({node_of(SphereShape{{0, 0, 5}, 1}), node_of(HalfSpaceShape{{0, 1, 0}, -2})});
  const Model model = compile_scene(scene);
  const SurfaceTree whole = SurfaceTree::build(model);
  REQUIRE_FALSE(whole.unbounded_items().empty());
  CHECK_FALSE(ForeignBoundsMaker(whole).bounds({{true, false}, {}}, 1 << 20));
  CHECK(ForeignBoundsMaker(whole).bounds({{false, true}, {}}, 1 << 20));
}

TEST_CASE("with little room boxes that are near each other become one") {
  std::vector<CsgNode> balls;
  Dice dice(5);
  for (int i = 0; i < 2000; ++i) balls.push_back(node_of(SphereShape{dice.point(10), 0.1}));
  const Model model = compile_scene(scene_of(std::move(balls)));
  const SurfaceTree whole = SurfaceTree::build(model);
  std::vector<bool> held(model.objects.size());
  for (std::size_t i = 0; i < held.size(); i += 3) held[i] = true;
  const ForeignBoundsMaker maker(whole);
  const auto all = maker.bounds({held, {}}, 1 << 20),
             few = maker.bounds({held, {}}, 16 * sizeof(WideNode));
  REQUIRE((all && few));
  CHECK(all->nodes().size() > 1333 / WideNode::kWidth);
  CHECK(few->nodes().size() <= 16);
  CHECK(few->nodes().size() > 2);
}
