// Neighbours that help each other: what a node tells, gives away and takes.
#include <algorithm>
#include <set>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "node/node_at_work.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/own_pixels.hpp"
#include "regions/restrict.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 256;
/// The number of tiles of each node.
constexpr std::size_t kTiles = 64;
const Hypercube kCube = *Hypercube::of_size(4);

/// A mirror ball in the middle of four macro-regions of 128 × 128 pixels.
Model ball() {
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 256, "height": 256},
    "camera": {"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
    "background": [1,0.5,0.25], "lights": [{"type": "point", "position": [3,4,-5], "color": [1,1,1]}],
    "materials": {"m": {"reflect": 0.5}},
    "objects": [{"material": "m", "csg": {"type": "sphere", "center": [0,0,0], "radius": 1}}]})");
  REQUIRE(read.scene);
  return compile_scene(*read.scene);
}

MacroGrid grid() {
  const Model model = ball();
  return {CameraFrame::from(model.settings.camera, model.settings.image), {kSide / 2}, {kSide / 2}};
}

Bytes slice_of(Rank rank) {
  return encode_model(restrict_to_share(ball(), grid(), share_of(kCube, rank)));
}

RegionIndex region_of(Rank rank) {
  return {static_cast<std::uint16_t>(kCube.column_of(rank)),
          static_cast<std::uint16_t>(kCube.row_of(rank))};
}

std::vector<std::uint32_t> tiles_of(Rank rank) {
  const TilePlan plan(ball().settings.image, {16, 16}, grid());
  const auto tiles = plan.tiles_of(share_of(kCube, rank));
  return {tiles.begin(), tiles.end()};
}

control::Load load() {
  control::Load m = load_of({2, 2, 1, {kSide / 2}, {kSide / 2}});
  m.makes_copies = true;
  return m;
}

/// One of four nodes, when a picture has begun or is about to.
struct Worker : NodeAtWork {
  explicit Worker(Rank rank, bool begins = true, const control::Load& m = load())
      : NodeAtWork(kCube, rank, m, slice_of(rank)) {
    if (begins) begin();
  }
};

/// The messages that a node sends, sorted by kind.
struct Sent {
  std::vector<control::Share> wishes;
  std::vector<std::string> errors;
  std::vector<std::pair<Rank, BatchType>> offers;
  std::vector<std::pair<Rank, std::vector<std::uint32_t>>> tiles;
  std::vector<std::pair<Rank, std::vector<RayTask>>> rays;
  std::set<std::uint32_t> tiles_with_credit;
  std::size_t class_rays = 0;

  explicit Sent(Node& node) {
    const BatchLimits limits{.pixel_count = 4 * kSide * kSide,
                             .tile_count = 4 * kTiles,
                             .max_depth = 5,
                             .lights = 1,
                             .columns = 2,
                             .rows = 2,
                             .nodes = 4};
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (!looks_like_batch(o.message.frame)) {
        const auto decoded = decode(o.message.text());
        const auto& m = std::get<ControlMessage>(decoded);
        if (const auto* wish = std::get_if<control::Share>(&m)) wishes.push_back(*wish);
        if (const auto* error = std::get_if<control::NodeError>(&m))
          errors.push_back(error->message);
        continue;
      }
      const BatchType type = std::get<BatchHeader>(peek_header(o.message.frame)).type;
      if (type == BatchType::kIdle || type == BatchType::kIdleWithCopy)
        offers.emplace_back(*o.to, type);
      if (type == BatchType::kClassRays) ++class_rays;
      std::vector<std::uint32_t> numbers;
      std::vector<RayTask> forwarded;
      std::vector<TileCredit> credits;
      std::vector<Contribution> contributions;
      if (std::holds_alternative<BatchHeader>(
              decode_assignment(o.message.frame, limits, numbers))) {
        tiles.emplace_back(*o.to, numbers);
      } else if (std::holds_alternative<BatchHeader>(
                     decode_rays(o.message.frame, limits, forwarded))) {
        rays.emplace_back(*o.to, forwarded);
      } else if (std::holds_alternative<BatchHeader>(
                     decode_contributions(o.message.frame, limits, credits, contributions))) {
        for (const TileCredit& c : credits) tiles_with_credit.insert(c.tile);
      }
    }
  }
};

RayTask ray_in(RegionIndex region) {
  RayTask ray;
  ray.ray = {{0, 0, -5}, {0, 0, 1}};
  ray.t_max = 1;
  ray.kind = RayKind::kShadow;
  ray.weight = {1, 1, 1};
  ray.region = region;
  return ray;
}

}  // namespace

TEST_CASE(
    "a node with much left has its slice copied to a neighbour that is idle, and then gives it "
    "tiles") {
  Worker owner(Rank{0});
  const Rank helper = owner.neighbour(1);
  const auto own = tiles_of(Rank{0});
  REQUIRE(own.size() == kTiles);
  owner.assign(own);
  owner.node.on_neighbour(encode_offer(owner.stamp_of(helper), BatchType::kIdle, 0));
  // The work that a tile takes is not known yet.
  CHECK(Sent(owner.node).wishes.empty());
  std::vector<control::Share> wishes;
  int traced = 0;
  for (; traced < 8; ++traced) {
    REQUIRE(owner.work_once());
    const Sent sent(owner.node);
    wishes.insert(wishes.end(), sent.wishes.begin(), sent.wishes.end());
    CHECK(sent.tiles.empty());
  }
  REQUIRE(wishes.size() == 1);
  CHECK(wishes.front() == control::Share{1, 0, helper.value});
  owner.node.on_neighbour(encode_offer(owner.stamp_of(helper), BatchType::kIdleWithCopy, 0));
  const Sent sent(owner.node);
  REQUIRE(sent.tiles.size() == 1);
  CHECK(sent.tiles.front().first == helper);
  CHECK(sent.tiles.front().second.size() == 16);
  for (const std::uint32_t tile : sent.tiles.front().second) {
    CHECK(std::find(own.end() - 16, own.end(), tile) != own.end());
  }
  // Each offer gets one gift.
  CHECK(owner.work() == static_cast<int>(kTiles) - 16 - traced);
  CHECK(Sent(owner.node).tiles.empty());
}

TEST_CASE(
    "who has done as much as a node will have done gets nothing of it, and who has done a little "
    "less gets little") {
  // The work that the node has when it does everything by itself.
  Worker alone(Rank{0});
  alone.assign(tiles_of(Rank{0}));
  alone.work();
  std::uint64_t all = 0;
  for (const Node::Outgoing& o : alone.node.take_outgoing()) {
    if (looks_like_batch(o.message.frame))
      static_cast<void>(decode_offer(o.message.frame, {.nodes = 4}, all));
  }
  REQUIRE(all > 0);
  const auto given_to = [&](std::uint64_t offered_after) {
    Worker owner(Rank{0});
    const Rank helper = owner.neighbour(1);
    owner.assign(tiles_of(Rank{0}));
    for (const BatchType type : {BatchType::kIdle, BatchType::kIdleWithCopy}) {
      owner.node.on_neighbour(encode_offer(owner.stamp_of(helper), type, offered_after));
    }
    std::size_t tiles = 0;
    while (owner.work_once()) {
      for (const auto& gift : Sent(owner.node).tiles) tiles += gift.second.size();
    }
    return tiles;
  };
  CHECK(given_to(0) == 16);
  const std::size_t little = given_to(all - all / 8);
  CHECK(little > 0);
  CHECK(little < 10);
  CHECK(given_to(2 * all) == 0);
}

TEST_CASE("a node traces its own pixels beside its macro-region, and none of it that are others'") {
  control::Load with_own = load();
  with_own.grid.own_edges = {kSide / 2 + 16, kSide / 2};
  const Model model = ball();
  const TilePlan plan(model.settings.image, {16, 16}, grid(), with_own.grid.own_edges);
  const auto own_of = [&](Rank rank) { return plan.tiles_of(share_of(kCube, rank)); };
  const Rank first{0}, second = NodeMesh(kCube).owner_of(1, 0);
  REQUIRE(own_of(first).size() == kTiles + 8);
  REQUIRE(own_of(second).size() == kTiles - 8);
  const ModelContents contents =
      contents_with_own_pixels(model, grid(), share_of(kCube, first), with_own.grid.own_edges);
  NodeAtWork node(kCube, first, with_own, encode_model(extract(model, contents)));
  node.begin();
  node.assign(own_of(first));
  CHECK(Sent(node.node).errors.empty());
  CHECK(node.work() >= static_cast<int>(kTiles) + 8);
  const Sent sent(node.node);
  const auto own = own_of(first);
  CHECK(sent.tiles_with_credit == std::set<std::uint32_t>(own.begin(), own.end()));
  node.assign({own_of(second).front()});
  CHECK(Sent(node.node).errors.size() == 1);
}

TEST_CASE("an offer that comes before the picture begins here is not forgotten") {
  Worker owner(Rank{0}, false);
  const Rank helper = owner.neighbour(1);
  owner.node.on_neighbour(encode_offer(owner.stamp_of(helper), BatchType::kIdle, 0));
  CHECK(Sent(owner.node).wishes.empty());
  owner.begin();
  owner.assign(tiles_of(Rank{0}));
  for (int i = 0; i < 8; ++i) owner.work_once();
  const Sent sent(owner.node);
  REQUIRE(sent.wishes.size() == 1);
  CHECK(sent.wishes.front() == control::Share{1, 0, helper.value});
}

TEST_CASE(
    "an idle node says so once, and again with a copy; then it traces its neighbour's tiles") {
  Worker helper(Rank{0});
  const Rank owner = helper.neighbour(0);
  helper.assign(tiles_of(Rank{0}));
  CHECK(helper.work() == static_cast<int>(kTiles));
  const Sent idle(helper.node);
  REQUIRE(idle.offers.size() == 2);
  for (const auto& [to, type] : idle.offers) CHECK(type == BatchType::kIdle);
  CHECK(helper.work() == 0);
  CHECK(Sent(helper.node).offers.empty());

  helper.tell(control::Copy{1, 0, owner.value}, slice_of(owner));
  CHECK(helper.work() == 1);
  const Sent ready(helper.node);
  REQUIRE(ready.offers.size() == 1);
  CHECK(ready.offers.front() == std::pair{owner, BatchType::kIdleWithCopy});

  const std::uint32_t tile = tiles_of(owner).front();
  helper.node.on_neighbour(encode_assignment(helper.stamp_of(owner), std::vector{tile}));
  // There may also be rays that left it for the node's own regions.
  CHECK(helper.work() >= 1);
  const Sent sent(helper.node);
  CHECK(sent.tiles_with_credit == std::set{tile});
  CHECK(sent.errors.empty());
  // Rays that left the copy crossed the bit that leads there from the owner, or stayed here.
  for (const auto& [to, rays] : sent.rays) {
    for (const RayTask& ray : rays) {
      const Rank next = NodeMesh(kCube).owner_of(ray.region.column, ray.region.row);
      CHECK(kCube.link_between(Rank{0}, to) == kCube.link_between(owner, next));
    }
  }
}

TEST_CASE("an idle node gets rays of a neighbour's regions and traces them there") {
  Worker helper(Rank{0});
  const Rank owner = helper.neighbour(1);
  SECTION("with a copy") {
    helper.tell(control::Copy{1, 0, owner.value}, slice_of(owner));
    helper.work();
    helper.node.on_neighbour(
        encode_rays(helper.stamp_of(owner), std::vector{ray_in(region_of(owner))}));
    CHECK(helper.work() == 1);
    CHECK(Sent(helper.node).errors.empty());
  }
  SECTION("not without") {
    helper.node.on_neighbour(
        encode_rays(helper.stamp_of(owner), std::vector{ray_in(region_of(owner))}));
    CHECK(helper.work() == 0);
    CHECK(Sent(helper.node).errors.size() == 1);
  }
}

TEST_CASE("rays for another neighbour are sent on, others refused") {
  Worker between(Rank{0});
  const Rank from = between.neighbour(0), to = between.neighbour(1);
  SECTION("a neighbour's") {
    between.node.on_neighbour(
        encode_rays(between.stamp_of(from), std::vector{ray_in(region_of(to))}));
    CHECK(between.work() == 0);
    const Sent sent(between.node);
    REQUIRE(sent.rays.size() == 1);
    CHECK(sent.rays.front().first == to);
    REQUIRE(sent.rays.front().second.size() == 1);
    CHECK(sent.rays.front().second.front().region == region_of(to));
  }
  SECTION("another node's") {
    const Rank far = kCube.neighbour(from, 1);
    between.node.on_neighbour(
        encode_rays(between.stamp_of(from), std::vector{ray_in(region_of(far))}));
    CHECK(Sent(between.node).errors.size() == 1);
  }
}

TEST_CASE("a full node keeps rays between its neighbours until its outboxes have room") {
  control::Load small = load();
  small.link_credit_bytes = kRayBytes;
  small.outbox_rays = 1;
  Worker between(Rank{0}, true, small);
  const Rank from = between.neighbour(0), to = between.neighbour(1);
  const auto receive = [&](BatchType type) {
    between.node.on_neighbour(
        encode_rays(between.stamp_of(from), std::vector{ray_in(region_of(to))}, type));
    CHECK(between.work() == 0);
    return Sent(between.node);
  };
  CHECK(receive(BatchType::kRays).rays.size() == 1);
  // The second takes its class's place, the third fills the outbox.
  const Sent second = receive(BatchType::kRays);
  CHECK(second.rays.empty());
  CHECK(second.class_rays == 1);
  for (int i = 0; i < 3; ++i) {
    const Sent sent = receive(i == 1 ? BatchType::kClassRays : BatchType::kRays);
    CHECK(sent.rays.size() + sent.class_rays == 0);
  }
  CHECK(between.node.wait_reason() == WaitReason::kBlocked);
  std::size_t passed = 0;
  for (int i = 0; i < 3; ++i) {
    CHECK(between.node.has_unfinished());
    between.node.on_neighbour(encode_link_credit(between.stamp_of(to), kRayBytes));
    CHECK(between.work() == 0);
    for (const auto& [peer, rays] : Sent(between.node).rays) passed += peer == to ? rays.size() : 0;
  }
  CHECK(passed == 3);
}

TEST_CASE("tiles that a node can't trace are refused") {
  Worker helper(Rank{0});
  const Rank owner = helper.neighbour(0), other = helper.neighbour(1);
  SECTION("without a copy") {
    helper.node.on_neighbour(encode_assignment(helper.stamp_of(owner), tiles_of(owner)));
    CHECK(Sent(helper.node).errors.size() == 1);
  }
  SECTION("of another node's regions") {
    helper.tell(control::Copy{1, 0, owner.value}, slice_of(owner));
    helper.work();
    helper.node.on_neighbour(encode_assignment(helper.stamp_of(owner), tiles_of(other)));
    CHECK(Sent(helper.node).errors.size() == 1);
  }
}
