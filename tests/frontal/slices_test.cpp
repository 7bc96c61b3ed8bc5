// The parts of a scene that each node gets.
#include "frontal/preparation/slices.hpp"

#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "frontal/prepared.hpp"
#include "proto/bounds_bytes.hpp"
#include "proto/horizon_bytes.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/restrict.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Balls all over a block of space in front of the eye, lit from the side.
Scene many_balls() {
  Dice dice(7);
  std::vector<CsgNode> balls;
  for (int i = 0; i < 1500; ++i)
    balls.push_back(node_of(SphereShape{dice.point(10), dice.between(0.1, 0.4)}));
  Scene scene = scene_of(std::move(balls));
  scene.settings.camera.eye = {0, 0, -30};
  scene.settings.camera.look_at = {0, 0, 0};
  scene.settings.camera.up = {0, 1, 0};
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 45;
  scene.settings.image = {256, 256, 1};
  scene.settings.lights = {{{-40, 30, -20}, {1, 1, 1}, Falloff::kNone}};
  return scene;
}

struct Slice {
  Model model;
  std::optional<ForeignBounds> foreign_bounds;
  bool has_foreign_horizons;
};

std::vector<Slice> slices(const PreparedScene& prepared) {
  std::vector<Slice> all;
  for (const SharedBytes& bytes : prepared.slices) {
    std::span<const std::byte> rest = bytes.bytes().first(bytes.size() - prepared.horizon_bytes);
    auto model = take_model(rest);
    REQUIRE(model.index() == 0);
    std::optional<ForeignBounds> bounds;
    if (begins_with_bounds(rest)) {
      bounds = take_bounds(rest);
      REQUIRE(bounds);
    }
    all.push_back({std::get<Model>(std::move(model)), std::move(bounds), !rest.empty()});
    if (!rest.empty()) REQUIRE(decode_horizons(rest, all.back().model.settings.lights.size()));
  }
  return all;
}

}  // namespace

TEST_CASE(
    "with light horizons nodes get occluders too, but less than half of a scene, and without only "
    "their own part") {
  const PreparedScene with = prepared(many_balls(), {.shadows = ShadowMode::kHorizon}, 16);
  const PreparedScene without = prepared(many_balls(), {.shadows = ShadowMode::kForward}, 16);
  const PreparedScene historical =
      prepared(many_balls(), {.shadows = ShadowMode::kHorizon, .flow = FlowMode::kBlocking}, 16);
  const auto more = slices(with), own = slices(without), as_in_1987 = slices(historical);
  std::size_t more_in_all = 0, own_in_all = 0;
  for (std::size_t rank = 0; rank < 16; ++rank) {
    INFO("rank " << rank);
    CHECK(more[rank].has_foreign_horizons);
    CHECK_FALSE(own[rank].has_foreign_horizons);
    CHECK_FALSE(as_in_1987[rank].has_foreign_horizons);
    CHECK(more[rank].foreign_bounds);
    CHECK_FALSE(own[rank].foreign_bounds);
    CHECK_FALSE(as_in_1987[rank].foreign_bounds);
    CHECK(more[rank].model.objects.size() < 750);
    more_in_all += more[rank].model.objects.size();
    own_in_all += own[rank].model.objects.size();
  }
  // Partitions differ, but the sum of their parts hardly does.
  CHECK(own_in_all < 2400);
  CHECK(more_in_all > own_in_all + 700);
}

TEST_CASE("nodes know where all is that they do not hold, and all hold a floor without bounds") {
  Scene scene = many_balls();
  scene.objects.push_back(scene_of({node_of(HalfSpaceShape{{0, 1, 0}, -12})}).objects.front());
  const Model model = compile_scene(scene);
  const auto floor = static_cast<std::uint32_t>(model.objects.size() - 1);
  TreeScratch scratch;
  const auto all = slices(prepared(scene, {}, 16));
  for (std::size_t rank = 0; rank < 16; ++rank) {
    INFO("rank " << rank);
    const auto& held = all[rank].model.objects;
    REQUIRE(std::ranges::any_of(held,
                                [&](const Object& o) { return o.id == model.objects[floor].id; }));
    REQUIRE(all[rank].foreign_bounds);
    CHECK(all[rank].foreign_bounds->memory_bytes() <= kSmallBounds);
    // Rays through the middle of each ball, from just before it to just behind.
    std::size_t met = 0, foreign = 0;
    for (std::uint32_t i = 0; i < floor; ++i) {
      const Aabb& box = model.objects[i].bounds;
      const double radius = 0.5 * (box.hi.x - box.lo.x);
      RayPacket packet;
      packet.add({box.center() - Vec3{2, 0, 0}, {1, 0, 0}}, 2 - radius, 2 + radius);
      const bool is_held =
          std::ranges::any_of(held, [&](const Object& o) { return o.id == model.objects[i].id; });
      const bool may_meet = all[rank].foreign_bounds->may_meet(packet, scratch) != 0;
      if (!is_held) REQUIRE(may_meet);
      met += may_meet ? 1 : 0;
      foreign += is_held ? 0 : 1;
    }
    CHECK(foreign > 750);
    // Boxes of foreign objects reach into balls that are held.
    CHECK(met < foreign + (floor - foreign) / 2);
  }
}

TEST_CASE(
    "where one node can't know where all is, none does, and own pixels are the macro-regions'") {
  // A floor with more holes than any node has room for: each holds a part of it, and its bounds are
  // all of space.
  Scene scene = many_balls();
  std::vector<CsgNode> holes{node_of(HalfSpaceShape{{0, 1, 0}, -5})};
  Dice dice(3);
  for (int i = 0; i < 1500; ++i)
    holes.push_back(node_of(SphereShape{{dice.between(-12, 12), -5, dice.between(-12, 12)}, 0.2}));
  scene.objects = scene_of({operation(Operation::kDifference, std::move(holes))}).objects;
  const PreparedScene cut = prepared(scene, {}, 16);
  CHECK(cut.partition == PartitionMode::kBalanced);
  CHECK(cut.grid.own_edges.empty());
  CHECK_FALSE(prepared(many_balls(), {}, 16).grid.own_edges.empty());
  const auto all = slices(cut);
  for (std::size_t rank = 0; rank < 16; ++rank) {
    INFO("rank " << rank);
    CHECK_FALSE(all[rank].foreign_bounds);
    CHECK(all[rank].model.primitives.size() < 1501);
  }
}

TEST_CASE("where objects without bounds are too many for one node, no node knows what is foreign") {
  // Floors one below the other, all below the picture's middle, are too many for the nodes above
  // it.
  std::vector<CsgNode> floors;
  for (int i = 0; i < 80; ++i) floors.push_back(node_of(HalfSpaceShape{{0, 1, 0}, -2.0 - i}));
  Scene scene = many_balls();
  scene.objects = scene_of(std::move(floors)).objects;
  // Regular, because rows that aren't cut in the middle reach the floors behind the eye.
  const auto all = slices(prepared(scene, {.partition = PartitionMode::kRegular}, 16));
  std::size_t fewest = 80;
  for (std::size_t rank = 0; rank < 16; ++rank) {
    INFO("rank " << rank);
    CHECK_FALSE(all[rank].foreign_bounds);
    fewest = std::min(fewest, all[rank].model.objects.size());
  }
  CHECK(fewest < 80);
}

TEST_CASE("what a node gets beside its own part is what its shadow rays ask for") {
  const Scene scene = many_balls();
  const Model model = compile_scene(scene);
  const PreparedScene cut = prepared(scene, {}, 16);
  const auto frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const MacroGrid grid(frame, cut.grid.column_edges, cut.grid.row_edges);
  const Hypercube cube = *Hypercube::of_size(16);
  // The light shines from the left and above: of two nodes with as much of the scene, the one to
  // the lower right has more objects in its shadow rays' way.
  std::size_t beside_upper_left = 0, beside_lower_right = 0;
  const auto all = slices(cut);
  for (std::uint32_t rank = 0; rank < 16; ++rank) {
    const RegionShare share = share_of(cube, Rank{rank});
    const std::size_t own = restrict_to_share(model, grid, share).objects.size();
    REQUIRE(all[rank].model.objects.size() >= own);
    const std::size_t beside = all[rank].model.objects.size() - own;
    if (share.column < 2 && share.row < 2) beside_upper_left += beside;
    if (share.column >= 2 && share.row >= 2) beside_lower_right += beside;
  }
  CHECK(beside_lower_right != beside_upper_left);
  CHECK(2 * std::max(beside_lower_right, beside_upper_left) >
        3 * std::min(beside_lower_right, beside_upper_left));
}

TEST_CASE("a slice is the bytes of what is extracted") {
  std::size_t planes = 0, meshes = 0, parts = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const MacroGrid grid =
        MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 4);
    const SliceEncoder encoder(model);
    Dice dice(seed);
    for (std::uint32_t column = 0; column < 4; ++column) {
      ModelContents contents = contents_of_share(model, grid, {4, 4, column, 2});
      std::vector<bool> chosen(model.objects.size());
      for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = dice.one_in(4);
      contents.hold_whole(chosen);
      const Model slice = extract(model, contents);
      const Bytes tail(dice.below(3), std::byte{9});
      const std::span<const std::byte> tails[] = {tail};
      Bytes expected = encode_model(slice);
      expected.insert(expected.end(), tail.begin(), tail.end());
      REQUIRE(encoder.encode(contents, tails) == expected);
      planes += slice.planes.size();
      meshes += slice.meshes.size();
      parts += contents.parts.size();
    }
  }
  CHECK(planes > 100);
  CHECK(meshes > 100);
  CHECK(parts > 100);
}

TEST_CASE("objects add up to their model's bytes, but for outlines that they share") {
  std::size_t with_outlines = 0, shared = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    Model empty = model;
    empty.primitives.clear();
    empty.planes.clear();
    empty.meshes.clear();
    empty.outlines.clear();
    empty.nodes.clear();
    empty.objects.clear();
    std::size_t bytes = encoded_model_bytes(empty);
    for (const Object& object : model.objects) bytes += encoded_object_bytes(model, object);
    std::set<std::pair<std::uint32_t, std::uint32_t>> of_objects;
    for (const Object& object : model.objects) {
      for (const TreeNode& n : model.tree(object)) {
        if (n.size != 1) continue;
        const Primitive& p = model.primitives[n.primitive];
        if (csg::has_outline(p.kind)) of_objects.insert({object.id, p.outline});
      }
    }
    with_outlines += model.outlines.empty() ? 0 : 1;
    if (of_objects.size() > model.outlines.size()) {
      ++shared;
      CHECK(bytes > encoded_model_bytes(model));
    } else {
      CHECK(bytes == encoded_model_bytes(model));
    }
  }
  CHECK(with_outlines > 10);
  CHECK(shared < with_outlines);
}

TEST_CASE("room for slices is twice an equal share, or a little for small scenes") {
  CHECK(slice_room(1000, 16) == kSmallSlices);
  CHECK(bounds_room(1000, 16) == kSmallBounds);
  CHECK(bounds_room(std::uint64_t{160} << 20, 16) == std::uint64_t{5} << 19);
  CHECK(slice_room(std::uint64_t{160} << 20, 16) == std::uint64_t{20} << 20);
  CHECK(copy_room(1000, 16) == kSmallCopies);
  CHECK(copy_room(std::uint64_t{160} << 20, 16) == std::uint64_t{20} << 20);
}
