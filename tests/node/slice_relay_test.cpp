// Slices that come over links: parts are handed on along the ring or the tree, a node's own are put
// together.
#include <numeric>

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/one_ball.hpp"
#include "proto/model_slice.hpp"
#include "topology/slice_way.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kNodes = 8;
const Hypercube kCube = *Hypercube::of_size(kNodes);

control::Load load_of_mesh(MeshMode mode) {
  const NodeMesh mesh(kCube, mode);
  const auto edges = [](std::uint32_t cells) {
    std::vector<std::int64_t> e(cells - 1);
    std::iota(e.begin(), e.end(), 1);
    return e;
  };
  control::Load load =
      load_of({mesh.columns(), mesh.rows(), 1, edges(mesh.columns()), edges(mesh.rows())});
  load.mesh = mode;
  return load;
}

/// What nodes say: batches to neighbours, and messages to the frontal.
struct Said {
  std::vector<std::pair<Rank, Bytes>> parts;
  std::vector<std::string> errors;
  int ready = 0, acknowledged = 0;

  explicit Said(Node& node) {
    for (Node::Outgoing& o : node.take_outgoing()) {
      if (o.to) {
        const auto header = peek_header(o.message.frame);
        if (std::get<BatchHeader>(header).type == BatchType::kSlicePart)
          parts.emplace_back(*o.to, std::move(o.message.frame));
        continue;
      }
      const auto decoded = decode(o.message.text());
      const auto& m = std::get<ControlMessage>(decoded);
      ready += std::holds_alternative<control::Ready>(m);
      acknowledged += std::holds_alternative<control::EpochAck>(m);
      if (const auto* error = std::get_if<control::NodeError>(&m)) errors.push_back(error->message);
    }
  }
};

/// A slice in several parts.
Bytes long_slice() {
  Bytes slice(2 * SliceRelay::kPartBytes + 1000);
  for (std::size_t i = 0; i < slice.size(); ++i) slice[i] = static_cast<std::byte>(i * 31 >> 3);
  return slice;
}

NodeAtWork node_of(Rank rank, MeshMode mode) {
  return {kCube, rank, load_of_mesh(mode), rank == Rank{0} ? encode_model(one_ball()) : Bytes{}};
}

Bytes part_of(NodeAtWork& at, Rank from, const SlicePart& part) {
  return encode_slice_part(at.stamp_of(from), part);
}

}  // namespace

TEST_CASE("slices that rank 0 hands on reach each node whole, over links") {
  for (const MeshMode mode : {MeshMode::kRing, MeshMode::kTree}) {
    const auto way = *slice_way(kCube, mode);
    std::vector<NodeAtWork> nodes;
    for (std::uint32_t r = 0; r < kNodes; ++r) nodes.push_back(node_of(Rank{r}, mode));
    const Bytes slice = long_slice();
    for (const Rank target : way.farthest_first()) {
      INFO("mesh " << to_string(mode) << ", node " << target.value);
      nodes[0].tell(control::HandOn{1, 0, target.value}, slice);
      Rank at{0};
      Bytes whole;
      while (at != target) {
        const Said said(nodes[at.value].node);
        CHECK(said.errors.empty());
        CHECK(said.parts.size() == 3);
        const Rank next = *way.child_towards(at, target);
        for (const auto& [to, batch] : said.parts) {
          REQUIRE(to == next);
          REQUIRE(kCube.link_between(at, to));
          if (next == target) {
            SlicePart part;
            BatchLimits limits;
            limits.nodes = kNodes;
            REQUIRE(std::holds_alternative<BatchHeader>(decode_slice_part(batch, limits, part)));
            REQUIRE(part.offset == whole.size());
            whole.insert(whole.end(), part.bytes.begin(), part.bytes.end());
          }
          nodes[next.value].node.on_neighbour(batch);
        }
        at = next;
      }
      REQUIRE(whole == slice);
      // What came is no model, which only the node that put it together can find out.
      CHECK_FALSE(Said(nodes[target.value].node).ready);
      CHECK(nodes[target.value].work() == 1);
      CHECK(Said(nodes[target.value].node).errors.size() == 1);
    }
  }
}

TEST_CASE("a node is ready once its slice has come over links, and not before") {
  NodeAtWork at = node_of(kCube.ring_next(Rank{0}), MeshMode::kRing);
  CHECK(at.work() == 0);
  const Bytes slice = encode_model(one_ball());
  const std::uint32_t rank = kCube.ring_next(Rank{0}).value;
  const std::size_t half = slice.size() / 2;
  const std::span<const std::byte> bytes(slice);
  at.node.on_neighbour(part_of(at, Rank{0}, {rank, 0, slice.size(), bytes.first(half)}));
  CHECK(at.work() == 0);
  at.node.on_neighbour(part_of(at, Rank{0}, {rank, half, slice.size(), bytes.subspan(half)}));
  CHECK(at.work() == 1);
  const Said said(at.node);
  CHECK(said.ready == 1);
  CHECK(said.errors.empty());
}

TEST_CASE("nodes acknowledge a job whose slices come over links, once all neighbours are there") {
  for (const MeshMode mode : {MeshMode::k2d, MeshMode::kRing, MeshMode::kTree}) {
    Node node({Rank{1}, kIncarnation, 1, "ipc://here", 1, "test"});
    const auto tell = [&](const ControlMessage& m) {
      node.on_frontal(Message::of_text(encode(m), encode_model(one_ball())));
    };
    tell(control::Welcome{kNodes, "test", std::vector<std::string>(kNodes, "ipc://there"), 1000});
    tell(load_of_mesh(mode));
    CHECK(Said(node).acknowledged == 0);
    for (std::uint32_t bit = 0; bit < kCube.dimension(); ++bit) {
      const Rank peer = kCube.neighbour(Rank{1}, bit);
      node.on_neighbour(
          encode_signal({0, 0, peer.value, kIncarnation, 0}, BatchType::kGreetingAck));
    }
    CHECK(Said(node).acknowledged == (mode == MeshMode::k2d ? 0 : 1));
  }
}

TEST_CASE("parts of slices from the wrong side, out of order or for the wrong node fail the job") {
  const Bytes slice = long_slice();
  const Rank second = kCube.ring_next(Rank{0}), third = kCube.ring_next(second);
  const SlicePart part{second.value, 0, slice.size(), {slice.data(), 100}};
  const auto errors_after = [&](Rank from, const SlicePart& p) {
    NodeAtWork at = node_of(second, MeshMode::kRing);
    at.node.on_neighbour(part_of(at, from, p));
    return Said(at.node).errors.size();
  };
  CHECK(errors_after(Rank{0}, part) == 0);
  CHECK(errors_after(third, part) == 1);
  SlicePart late = part;
  late.offset = 1;
  CHECK(errors_after(Rank{0}, late) == 1);
  SlicePart lost = part;
  lost.rank = 0;
  CHECK(errors_after(Rank{0}, lost) == 1);
  SlicePart beyond = part;
  beyond.total = 50;
  CHECK(errors_after(Rank{0}, beyond) == 1);

  NodeAtWork twice = node_of(second, MeshMode::kRing);
  const Bytes model = encode_model(one_ball());
  for (int i = 0; i < 2; ++i)
    twice.node.on_neighbour(part_of(twice, Rank{0}, {second.value, 0, model.size(), model}));
  CHECK(Said(twice.node).errors.size() == 1);
}

TEST_CASE("where each node gets its slice from the frontal, none is taken from a neighbour") {
  NodeAtWork at(kCube, Rank{1}, load_of_mesh(MeshMode::k2d), encode_model(one_ball()));
  const Bytes slice = long_slice();
  at.node.on_neighbour(part_of(at, Rank{0}, {1, 0, slice.size(), {slice.data(), 10}}));
  at.tell(control::HandOn{1, 0, 3}, slice);
  const Said said(at.node);
  CHECK(said.parts.empty());
  CHECK(said.errors.empty());
}
