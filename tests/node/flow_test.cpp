// When rays and credit go out: full batches, parts of batches on quiet links, and the rest when
// there is nothing else to do; and how a full node goes on.

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "node/node_at_work.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kSide = 64, kBatchRays = 400, kCreditRays = 3200;
constexpr std::uint64_t kEighth = kCreditRays / 8;
const Hypercube kPair = *Hypercube::of_size(2);

/// A scene of nothing but background: rays leave every region that they cross.
Bytes nothing() {
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 64, "height": 64},
    "camera": {"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0], "fov": 40},
    "lights": [{"type": "point", "position": [9,4,-5], "color": [1,1,1]}], "objects": []})");
  REQUIRE(read.scene);
  return encode_model(compile_scene(*read.scene));
}

/// The left one of two nodes, the picture begun.
struct LeftNode : NodeAtWork {
  explicit LeftNode(const control::Load& m = load()) : NodeAtWork(kPair, left(), m, nothing()) {
    begin();
  }

  static Rank left() { return kPair.column_of(Rank{0}) == 0 ? Rank{0} : Rank{1}; }
  static control::Load load() {
    control::Load m = load_of({2, 1, 1, {kSide / 2}, {}});
    m.batch_bytes = kBatchRays * kRayBytes;
    m.link_credit_bytes = kCreditRays * kRayBytes;
    return m;
  }
  /// Receives rays from the right node that end here, or go back to it.
  void receive(std::size_t rays, bool go_back) {
    node.on_neighbour(encode_rays(stamp_of(neighbour(0)), std::vector(rays, ray(1, go_back))));
  }
  /// The same for rays on the credit of a class.
  void receive_on_class(std::size_t rays, std::uint16_t of_class, bool go_back) {
    node.on_neighbour(encode_rays(stamp_of(neighbour(0)), std::vector(rays, ray(of_class, go_back)),
                                  BatchType::kClassRays));
  }
  static RayTask ray(std::uint16_t hops, bool go_back) {
    RayTask ray;
    ray.hops = hops;
    ray.kind = RayKind::kShadow;
    ray.weight = {1, 1, 1};
    // +x points to the left of the picture.
    ray.ray = {{1, 0, 0}, {go_back ? -1.0 : 1.0, 0, 0}};
    ray.t_max = 5;
    return ray;
  }
};

struct Sent {
  std::vector<std::size_t> batches;                     // rays in each
  std::vector<std::uint64_t> grants;                    // rays' worth in each
  std::vector<std::uint16_t> class_rays, class_grants;  // their classes
  bool has_error = false;

  explicit Sent(Node& node) {
    const BatchLimits limits{.pixel_count = kSide * kSide,
                             .tile_count = 16,
                             .max_depth = 5,
                             .lights = 1,
                             .columns = 2,
                             .rows = 1,
                             .nodes = 2};
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (!looks_like_batch(o.message.frame)) {
        has_error = has_error || o.message.text().find("node_error") != std::string_view::npos;
        continue;
      }
      const auto header = std::get<BatchHeader>(peek_header(o.message.frame));
      if (header.type == BatchType::kRays) batches.push_back(header.count);
      std::vector<RayTask> rays;
      if (std::holds_alternative<BatchHeader>(
              decode_rays(o.message.frame, limits, rays, BatchType::kClassRays))) {
        for (const RayTask& ray : rays) class_rays.push_back(ray.hops);
      }
      std::vector<std::uint16_t> classes;
      if (std::holds_alternative<BatchHeader>(
              decode_class_credit(o.message.frame, limits, classes))) {
        class_grants.insert(class_grants.end(), classes.begin(), classes.end());
      }
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

namespace {

using Classes = std::vector<std::uint16_t>;
constexpr std::uint32_t kFull = 10, kCreditOfFull = 4;

/// A node with credit for four rays, full with ten in its outbox, and two places for each class.
struct FullNode : LeftNode {
  FullNode() : LeftNode(small()) {
    receive(kCreditOfFull + kFull, true);
    CHECK(work() == 1);
    const Sent sent(node);
    CHECK(sent.batches == std::vector<std::size_t>{kCreditOfFull});
    // One ray takes a place of its class: then the node isn't full. Of two more, one takes a place.
    CHECK(sent.class_rays == Classes{2});
    receive(2, true);
    CHECK(work() == 1);
    CHECK(Sent(node).class_rays == Classes{2});
  }
  static control::Load small() {
    control::Load m = load();
    m.link_credit_bytes = kCreditOfFull * kRayBytes;
    m.outbox_rays = kFull;
    m.class_places = 2;
    return m;
  }
  void grant_classes(const Classes& classes) {
    node.on_neighbour(encode_class_credit(stamp_of(neighbour(0)), classes));
  }
};

}  // namespace

TEST_CASE("a full node takes nothing that came on its link's credit until its outbox has emptied") {
  FullNode full;
  full.receive(3, true);
  full.assign({0});
  CHECK_FALSE(full.work_once());
  CHECK(full.node.wait_reason() == WaitReason::kBlocked);
  CHECK(full.node.has_unfinished());
  full.grant_classes({2});
  CHECK(Sent(full.node).class_rays == Classes{2});
  CHECK(full.node.wait_reason() == WaitReason::kReady);
  CHECK(full.work_once());
}

TEST_CASE(
    "a full node traces what comes on class credit, highest class first, where there is room for "
    "the next") {
  FullNode full;
  full.receive_on_class(1, 3, true);
  full.receive_on_class(1, 5, true);
  CHECK(full.work_once());
  CHECK(Sent(full.node).class_grants == Classes{5});
  CHECK(full.work_once());
  Sent sent(full.node);
  CHECK(sent.class_grants == Classes{3});
  // Their children go on in two places of each class; a third of class 6 finds none.
  full.receive_on_class(1, 5, true);
  CHECK(full.work_once());
  full.receive_on_class(2, 5, true);
  CHECK(full.work_once());
  CHECK(Sent(full.node).class_grants == Classes{5, 5});
  // One of class 6 is in the outbox now, and there is no room for children of more of class 5.
  full.receive_on_class(1, 5, true);
  CHECK_FALSE(full.work_once());
  CHECK(full.node.wait_reason() == WaitReason::kBlocked);
  full.receive_on_class(1, 6, false);
  CHECK(full.work_once());
  full.grant_classes({6});
  CHECK(Sent(full.node).class_rays == Classes{6});
  CHECK(full.work_once());
}

TEST_CASE(
    "what descends from rays on class credit is sent before all else when the link has credit") {
  FullNode full;
  full.receive_on_class(2, 5, true);
  full.receive_on_class(1, 6, true);
  CHECK(full.work() == 3);
  full.receive_on_class(2, 5, true);
  CHECK(full.work() == 1);
  Sent before(full.node);
  full.node.on_neighbour(encode_link_credit(full.stamp_of(full.neighbour(0)), 40 * kRayBytes));
  const Sent after(full.node);
  REQUIRE(after.batches.size() == 2);
  CHECK(after.batches[0] == 1);
  CHECK(after.class_rays.empty());
}

TEST_CASE("more rays of a class than there are places for end the job") {
  FullNode full;
  full.receive_on_class(2, 7, false);
  CHECK_FALSE(Sent(full.node).has_error);
  full.receive_on_class(1, 7, false);
  CHECK(Sent(full.node).has_error);
}
