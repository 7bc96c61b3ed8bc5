// Rays that begin where their node finished another ray, several links from their own
// macro-region's node: they are sent to that node.
#include <algorithm>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "node/node_at_work.hpp"
#include "proto/bounds_bytes.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/restrict.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 64;
/// Four columns and two rows.
const Hypercube kCube = *Hypercube::of_size(8);
const Vec3 kFirstMirror{-6, 2, 5}, kSecondMirror{2, 2, 5}, kBall{2, 2, 9};

/// A cube of side 2 about a point, without the part that lies beyond the point in a
/// direction.
CsgNode mirror_at(const Vec3& p, const Vec3& towards) {
  const HalfSpaceShape cut{towards, dot(towards, p)};
  return operation(Operation::kIntersection,
                   {node_of(BoxShape{p - Vec3{1, 1, 1}, p + Vec3{1, 1, 1}}), node_of(cut)});
}

/// Rays along z meet the first mirror, go along x to the second, two columns further, and from
/// there along z to a ball.
Model mirrors() {
  Scene scene = scene_of({mirror_at(kFirstMirror, {1, 0, -1}), mirror_at(kSecondMirror, {-1, 0, 1}),
                          node_of(SphereShape{kBall, 1})});
  for (NamedMaterial& m : scene.materials) {
    m.material.reflect = 0.5;
    m.material.transmit = 0;
  }
  Camera& camera = scene.settings.camera;
  camera = {};
  camera.projection = Projection::kOrthographic;
  camera.eye = {0, 0, -20};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.width = 16;
  scene.settings.image = {kSide, kSide, 1};
  scene.settings.lights.clear();
  scene.settings.max_depth = 2;
  scene.settings.min_weight = 0;
  return compile_scene(scene);
}

MacroGrid grid() {
  const Model model = mirrors();
  return MacroGrid::regular(CameraFrame::from(model.settings.camera, model.settings.image), 4, 2);
}

Rank owner_at(const Vec3& p) {
  const RegionIndex region = grid().region_of_point(p);
  return NodeMesh(kCube).owner_of(region.column, region.row);
}

/// A slice with both mirrors, and the ball if `has_ball`; and foreign bounds of the rest.
Bytes slice(bool has_ball) {
  const Model model = mirrors();
  const ModelContents contents{{true, true, has_ball}, {}};
  const SurfaceTree whole = SurfaceTree::build(model);
  const Bytes bounds = encode_bounds(*ForeignBoundsMaker(whole).bounds(contents, 1 << 16));
  const std::span<const std::byte> tails[] = {bounds};
  return SliceEncoder(model).encode(contents, tails);
}

NodeAtWork node_at(Rank rank, const Bytes& slice) {
  const MacroGrid all = grid();
  NodeAtWork node(kCube, rank, load_of({4, 2, 1, all.column_edges(), all.row_edges(), {}}), slice);
  node.begin();
  return node;
}

struct Batch {
  Rank to;
  std::vector<RayTask> rays;
};

std::vector<Batch> rays_of(Node& node) {
  const BatchLimits limits{.pixel_count = kSide * kSide,
                           .tile_count = 16,
                           .max_depth = 2,
                           .lights = 1,
                           .columns = 4,
                           .rows = 2,
                           .nodes = 8};
  std::vector<Batch> batches;
  for (const Node::Outgoing& o : node.take_outgoing()) {
    std::vector<RayTask> rays;
    if (!o.to || !std::holds_alternative<BatchHeader>(decode_rays(o.message.frame, limits, rays)))
      continue;
    batches.push_back({*o.to, std::move(rays)});
  }
  return batches;
}

std::vector<std::uint32_t> tiles_of(Rank rank) {
  const TilePlan plan(mirrors().settings.image, {16, 16}, grid());
  const auto tiles = plan.tiles_of(share_of(kCube, rank));
  return {tiles.begin(), tiles.end()};
}

}  // namespace

TEST_CASE("a ray that begins in a macro-region links away is sent there, link by link") {
  const Rank first = owner_at(kFirstMirror), last = owner_at(kSecondMirror);
  REQUIRE(kCube.link_between(first, last) == std::nullopt);
  NodeAtWork at_first = node_at(first, slice(false));
  at_first.assign(tiles_of(first));
  CHECK(at_first.work() > 0);
  const std::vector<Batch> sent = rays_of(at_first.node);
  REQUIRE(sent.size() == 1);
  const Rank between = kCube.neighbour(first, kCube.first_bit(first, last));
  CHECK(sent.front().to == between);
  // The rays have been at both mirrors.
  CHECK(sent.front().rays.size() > 50);
  for (const RayTask& ray : sent.front().rays) {
    REQUIRE(ray.depth == 2);
    REQUIRE(ray.region == grid().region_of_point(kSecondMirror));
    REQUIRE(ray.ray.direction.z > 0.99);
  }

  NodeAtWork at_between = node_at(between, slice(false));
  at_between.node.on_neighbour(encode_rays(at_between.stamp_of(first), sent.front().rays));
  CHECK(at_between.work() == 0);
  const std::vector<Batch> passed = rays_of(at_between.node);
  REQUIRE(passed.size() == 1);
  CHECK(passed.front().to == last);
  REQUIRE(passed.front().rays.size() == sent.front().rays.size());
  CHECK(passed.front().rays.front().hops == 2);

  NodeAtWork at_last = node_at(last, slice(true));
  at_last.node.on_neighbour(encode_rays(at_last.stamp_of(between), passed.front().rays));
  CHECK(at_last.work() > 0);
  CHECK(rays_of(at_last.node).empty());
}

TEST_CASE("a ray that is finished sends nothing, however far away") {
  const Rank first = owner_at(kFirstMirror);
  NodeAtWork at_first = node_at(first, slice(true));
  at_first.assign(tiles_of(first));
  CHECK(at_first.work() > 0);
  CHECK(rays_of(at_first.node).empty());
}

TEST_CASE(
    "rays that are on their way to another node are refused where none are finished beyond their "
    "regions") {
  const Rank first = owner_at(kFirstMirror), last = owner_at(kSecondMirror);
  const Rank between = kCube.neighbour(first, kCube.first_bit(first, last));
  NodeAtWork at_between = node_at(between, encode_model(mirrors()));
  RayTask ray;
  ray.ray = {kSecondMirror, {0, 0, 1}};
  ray.t_max = kInf;
  ray.kind = RayKind::kReflection;
  ray.depth = 1;
  ray.weight = {1, 1, 1};
  ray.region = grid().region_of_point(kSecondMirror);
  at_between.node.on_neighbour(encode_rays(at_between.stamp_of(first), std::vector{ray}));
  std::size_t errors = 0;
  for (const Node::Outgoing& o : at_between.node.take_outgoing()) {
    if (looks_like_batch(o.message.frame)) continue;
    const auto decoded = decode(o.message.text());
    errors += std::holds_alternative<control::NodeError>(std::get<ControlMessage>(decoded)) ? 1 : 0;
  }
  CHECK(errors == 1);
}
