// Foreign bounds over the wire.
#include "proto/bounds_bytes.hpp"
#include "geometry/infinity.hpp"

#include <cmath>

#include "catch.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

namespace {

/// The bytes of a slice behind its bounds.
const std::vector<std::byte> kRest(5, std::byte{7});

WideNode empty_node() {
  WideNode node;
  for (auto& axis : node.planes[0]) axis.fill(kFloatInf);
  for (auto& axis : node.planes[1]) axis.fill(-kFloatInf);
  node.child.fill(WideNode::kItemFlag);
  return node;
}

void put_box(WideNode& node, std::size_t place, float at,
             std::uint32_t child = WideNode::kItemFlag) {
  for (std::size_t a = 0; a < 3; ++a) {
    node.planes[0][a][place] = at + static_cast<float>(a);
    node.planes[1][a][place] = at + static_cast<float>(a) + 0.5f;
  }
  node.child[place] = child;
}

/// A chain of so many nodes; each has some boxes beside the next node.
std::vector<WideNode> chain(std::uint32_t count) {
  std::vector<WideNode> nodes(count, empty_node());
  for (std::uint32_t n = 0; n < count; ++n) {
    const bool is_last = n + 1 == count;
    for (std::uint32_t place = 0; place < 1 + n % WideNode::kWidth; ++place) {
      put_box(nodes[n], place, static_cast<float>(place),
              place == 0 && !is_last ? n + 1 : WideNode::kItemFlag);
    }
  }
  return nodes;
}

std::optional<ForeignBounds> taken(std::span<const std::byte> bytes) { return take_bounds(bytes); }

std::vector<std::byte> encoded(std::vector<WideNode> nodes) {
  return encode_bounds(ForeignBounds(std::move(nodes)));
}

bool are_same(const WideNode& a, const WideNode& b) {
  return a.planes == b.planes && a.child == b.child;
}

}  // namespace

TEST_CASE("foreign bounds arrive as they were sent, and what is behind them is left") {
  for (const std::uint32_t count : {0u, 1u, 2u, 20u}) {
    INFO(count << " nodes");
    const std::vector<WideNode> sent = chain(count);
    std::vector<std::byte> bytes = encoded(sent);
    bytes.insert(bytes.end(), kRest.begin(), kRest.end());
    std::span<const std::byte> rest = bytes;
    REQUIRE(begins_with_bounds(rest));
    const auto received = take_bounds(rest);
    REQUIRE(received);
    CHECK(std::vector(rest.begin(), rest.end()) == kRest);
    REQUIRE(received->nodes().size() == count);
    for (std::uint32_t n = 0; n < count; ++n) CHECK(are_same(received->nodes()[n], sent[n]));
  }
  CHECK_FALSE(begins_with_bounds(kRest));
  CHECK_FALSE(begins_with_bounds({}));
}

TEST_CASE("foreign bounds that can't be walked are refused") {
  const auto good = encoded(chain(4));
  REQUIRE(taken(good));
  for (std::size_t size = 0; size < good.size(); ++size) {
    INFO(size << " of " << good.size() << " bytes");
    REQUIRE_FALSE(taken(std::span(good).first(size)));
  }
  // Broken are: the magic; more nodes than bytes; a node of no branches, and one of nine.
  constexpr std::size_t kFirstNode = 8;
  for (const auto& [at, value] :
       {std::pair{std::size_t{0}, 0}, {std::size_t{7}, 1}, {kFirstNode, 0}, {kFirstNode, 9}}) {
    auto broken = good;
    broken[at] = std::byte(value);
    CHECK_FALSE(taken(broken));
  }
  const auto with_child = [](std::uint32_t parent, std::uint32_t child) {
    auto nodes = chain(4);
    nodes[parent].child[0] = child;
    return encoded(nodes);
  };
  CHECK(taken(with_child(2, 3)));
  CHECK_FALSE(taken(with_child(2, 2)));  // itself
  CHECK_FALSE(taken(with_child(2, 1)));  // back
  CHECK_FALSE(taken(with_child(2, 4)));  // there is none
  CHECK_FALSE(taken(with_child(1, 3)));  // node 3 has two parents then
}

TEST_CASE("foreign bounds that are no boxes, or too deep for a walk, are refused") {
  const float no_number = std::nanf("");
  for (const float lower : {0.75f, no_number}) {
    auto nodes = chain(2);
    nodes[1].planes[0][1][1] = lower;
    nodes[1].planes[1][1][1] = 0.5f;
    CHECK_FALSE(taken(encoded(nodes)));
  }
  const auto deepest = static_cast<std::uint32_t>(SurfaceTree::kMaxDepth);
  CHECK(taken(encoded(chain(deepest + 1))));
  CHECK_FALSE(taken(encoded(chain(deepest + 2))));
}

TEST_CASE("foreign bounds with random bytes changed are refused, or can be walked") {
  const auto good = encoded(chain(12));
  std::size_t refused = 0, read = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    auto bytes = good;
    for (std::uint64_t i = 0; i <= random.below(3); ++i)
      bytes[random.below(bytes.size())] = std::byte(random.below(256));
    const auto received = taken(bytes);
    ++(received ? read : refused);
    if (!received) continue;
    RayPacket packet;
    packet.add({{-9, 0.1, 0.2}, {1, 0.1, 0.2}}, 0, 100);
    TreeScratch scratch;
    REQUIRE(received->may_meet(packet, scratch) <= 1);
    REQUIRE(taken(encode_bounds(*received)));
  }
  CHECK(refused > 200);
  CHECK(read > 200);
}
