// A node in the tree of sums: how it passes on the light that others send it.

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/one_ball.hpp"
#include "proto/model_slice.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

control::Load load(SumsMode sums) {
  control::Load m = load_of({2, 1, 1, {8}, {}});
  m.sums = sums;
  return m;
}

/// One of two nodes, each of which has a tile, when a picture has begun.
struct Summer : NodeAtWork {
  Summer(Rank rank, SumsMode sums)
      : NodeAtWork(*Hypercube::of_size(2), rank, load(sums), encode_model(one_ball())) {
    begin();
  }
  /// Light that the other node sends, with half a ray's credit of the other tile.
  void receive(std::uint32_t pixel, const FixedRgb& light) {
    TileCredit credit{1, {}};
    credit.credit.add_power(1);
    const Contribution c{pixel, light};
    node.on_neighbour(
        encode_contributions(stamp_of(neighbour(0)), std::span(&credit, 1), std::span(&c, 1)));
  }
};

/// The one batch of contributions among what a node sends; to the frontal or to that rank.
struct SentLight {
  std::vector<TileCredit> credits;
  std::vector<Contribution> contributions;

  SentLight(const std::vector<Node::Outgoing>& sent, std::optional<Rank> to) {
    BatchLimits limits{.pixel_count = 256, .tile_count = 2, .nodes = 2};
    int batches = 0;
    for (const Node::Outgoing& o : sent) {
      if (o.to != to || !looks_like_batch(o.message.frame)) continue;
      const auto header = peek_header(o.message.frame);
      if (std::get<BatchHeader>(header).type != BatchType::kContributions) continue;
      const auto result = decode_contributions(o.message.frame, limits, credits, contributions);
      REQUIRE(std::holds_alternative<BatchHeader>(result));
      ++batches;
    }
    CHECK(batches == 1);
  }
  FixedRgb of(std::uint32_t pixel) const {
    FixedRgb sum;
    for (const Contribution& c : contributions) {
      if (c.pixel == pixel) sum.add(c.light);
    }
    return sum;
  }
};

bool is_refused(Node& node) {
  for (const Node::Outgoing& o : node.take_outgoing()) {
    if (o.to || looks_like_batch(o.message.frame)) continue;
    const auto decoded = decode(o.message.text());
    const auto* m = std::get_if<ControlMessage>(&decoded);
    if (m != nullptr && std::holds_alternative<control::NodeError>(*m)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE(
    "a node that has nothing to do sends its child's light on at once, all of it as one batch") {
  Summer root(Rank{0}, SumsMode::kTree);
  root.receive(9, {1, 2, 3});
  root.receive(9, {10, 20, 30});
  const SentLight sent(root.node.take_outgoing(), std::nullopt);
  REQUIRE(sent.contributions.size() == 1);
  CHECK(sent.of(9) == FixedRgb{11, 22, 33});
  REQUIRE(sent.credits.size() == 1);
  CHECK(sent.credits.front().credit.is_exactly(1));
  CHECK(root.node.take_outgoing().empty());
}

TEST_CASE("light that comes while an evaluator is at work goes on with the node's own") {
  Summer root(Rank{0}, SumsMode::kTree);
  root.assign({0});
  auto work = root.node.take_work();
  REQUIRE(work);
  root.receive(0, {1, 2, 3});
  CHECK(root.node.take_outgoing().empty());
  Workbench bench;
  root.node.give_result(bench.run(*std::move(work)));
  CHECK_FALSE(root.node.take_work());
  const SentLight sent(root.node.take_outgoing(), std::nullopt);
  // Pixel 0 shows the background: 1, 0.5, 0.25.
  CHECK(sent.of(0) == FixedRgb{(1ll << 32) + 1, (1ll << 31) + 2, (1ll << 30) + 3});
  CHECK(sent.contributions.size() == 8 * 16);
  CHECK(sent.credits.size() == 2);
}

TEST_CASE("a node sends its own light to its parent, in the order of the link's other batches") {
  Summer leaf(Rank{1}, SumsMode::kTree);
  leaf.assign({1});
  CHECK(leaf.work_once());
  CHECK_FALSE(leaf.node.take_work());
  const SentLight sent(leaf.node.take_outgoing(), Rank{0});
  CHECK(sent.of(15) == FixedRgb{1ll << 32, 1ll << 31, 1ll << 30});
}

TEST_CASE(
    "contributions from anybody but a child are an error, and so are all where sums are direct") {
  Summer leaf(Rank{1}, SumsMode::kTree);
  leaf.receive(9, {1, 2, 3});
  CHECK(is_refused(leaf.node));
  Summer direct(Rank{0}, SumsMode::kDirect);
  direct.receive(9, {1, 2, 3});
  CHECK(is_refused(direct.node));
  Summer root(Rank{0}, SumsMode::kTree);
  root.receive(4 * 256, {1, 2, 3});  // beyond the AOVs' slots
  CHECK(is_refused(root.node));
}
