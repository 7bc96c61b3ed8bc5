// When rays and credit go out: full batches, parts of them on quiet links, what is left when nothing else is to do.
#include <catch2/catch.hpp>

#include "node/node_at_work.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"
#include "scene/read_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 64, kBatchRays = 400, kCreditRays = 3200;
constexpr std::uint64_t kEighth = kCreditRays / 8;
const Hypercube kPair = *Hypercube::of_size(2);

/// Nothing but background: what rays cross, they leave.
Bytes nothing() {
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 64, "height": 64},
    "camera": {"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
    "lights": [{"type": "point", "position": [9,4,-5], "color": [1,1,1]}], "objects": []})");
  REQUIRE(read.scene);
  return encode_model(compile_scene(*read.scene));
}

/// The left one of two nodes, the picture begun.
struct LeftNode : NodeAtWork {
  LeftNode() : NodeAtWork(kPair, left(), load(), nothing()) { begin(); }

  static Rank left() { return kPair.column_of(Rank{0}) == 0 ? Rank{0} : Rank{1}; }
  static control::Load load() {
    control::Load m = load_of({2, 1, 1, {kSide / 2}, {}});
    m.batch_bytes = kBatchRays * kRayBytes;
    m.link_credit_bytes = kCreditRays * kRayBytes;
    return m;
  }
  /// From the right: rays that end here, or go on to where they came from.
  void receive(std::size_t rays, bool go_back) {
    RayTask ray;
    ray.kind = RayKind::kShadow;
    ray.weight = {1, 1, 1};
    // To the left of the picture is +x.
    ray.ray = {{1, 0, 0}, {go_back ? -1.0 : 1.0, 0, 0}};
    ray.t_max = 5;
    node.on_neighbour(encode_rays(stamp_of(neighbour(0)), std::vector(rays, ray)));
  }
};

struct Sent {
  std::vector<std::size_t> batches;  // rays in each
  std::vector<std::uint64_t> grants;  // rays' worth in each

  explicit Sent(Node& node) {
    const BatchLimits limits{.pixel_count = kSide * kSide, .tile_count = 16, .max_depth = 5, .lights = 1,
                             .columns = 2, .rows = 1, .nodes = 2};
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (!looks_like_batch(o.message.frame)) continue;
      const auto header = std::get<BatchHeader>(peek_header(o.message.frame));
      if (header.type == BatchType::kRays) batches.push_back(header.count);
      std::uint64_t bytes = 0;
      const auto grant = decode_link_credit(o.message.frame, limits, bytes);
      if (std::holds_alternative<BatchHeader>(grant)) grants.push_back(bytes / kRayBytes);
    }
  }
};

}  // namespace

TEST_CASE("an idle node gives credit back when it is worth a message") {
  LeftNode left;
  left.receive(kEighth - 1, false);
  CHECK(left.work() > 0);
  CHECK(Sent(left.node).grants.empty());
  left.receive(1, false);
  CHECK(left.work() == 1);
  CHECK(Sent(left.node).grants == std::vector<std::uint64_t>{kEighth});
}

TEST_CASE("a node at work gives credit back by halves of a link's") {
  LeftNode left;
  left.receive(kCreditRays, false);
  std::size_t granted = 0;
  for (int i = 0; left.work_once(); ++i) {
    for (const std::uint64_t rays : Sent(left.node).grants) {
      CHECK(rays >= kCreditRays / 2);
      granted += rays;
    }
  }
  CHECK(granted >= kCreditRays / 2);
}

TEST_CASE("on a quiet link a quarter of a batch goes out, less when nothing else is to do") {
  LeftNode left;
  left.receive(kBatchRays / 4, true);
  CHECK(left.work_once());
  CHECK(Sent(left.node).batches == std::vector<std::size_t>{kBatchRays / 4});
  left.receive(20, true);
  CHECK(left.work_once());
  CHECK(Sent(left.node).batches.empty());
  CHECK_FALSE(left.work_once());
  CHECK(Sent(left.node).batches == std::vector<std::size_t>{20});
}

TEST_CASE("on a busy link only whole batches go out, and no more than there is credit for") {
  LeftNode left;
  left.receive(kCreditRays + 300, true);
  std::size_t sent = 0;
  while (left.work_once()) {
    for (const std::size_t rays : Sent(left.node).batches) {
      if (sent > kEighth) CHECK(rays == std::min<std::size_t>(kBatchRays, kCreditRays - sent));
      sent += rays;
    }
  }
  for (const std::size_t rays : Sent(left.node).batches) sent += rays;
  CHECK(sent == kCreditRays);
  left.node.on_neighbour(encode_link_credit(left.stamp_of(left.neighbour(0)), 300 * kRayBytes));
  CHECK(Sent(left.node).batches == std::vector<std::size_t>{300});
}
