// A node where light goes back along the rays' ways: how it answers rays, and what it refuses.
#include <utility>

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/one_ball.hpp"
#include "proto/model_slice.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

control::Load load(ReturnsMode returns) {
  control::Load m = load_of({2, 1, 1, {8}, {}});
  m.returns = returns;
  return m;
}

/// Rank 0 of two nodes, whose half of space is the left one, when a picture has begun.
struct Half : NodeAtWork {
  explicit Half(ReturnsMode returns)
      : NodeAtWork(*Hypercube::of_size(2), Rank{0}, load(returns), encode_model(one_ball())) {
    begin();
  }
  void receive(const RayTask& ray, BatchType type = BatchType::kRays) {
    node.on_neighbour(encode_rays(stamp_of(Rank{1}), {&ray, 1}, type));
  }
  /// The answers among what the node sends, all of which must go to the other node.
  std::vector<RayAnswer> answers() {
    std::vector<RayAnswer> all, some;
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (decode_answers(o.message.frame, {.nodes = 2}, some).index() != 0) continue;
      CHECK(o.to == Rank{1});
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
  bool has_failed() {
    for (const Node::Outgoing& o : node.take_outgoing()) {
      if (o.to || looks_like_batch(o.message.frame)) continue;
      const auto decoded = decode(o.message.text());
      const auto* m = std::get_if<ControlMessage>(&decoded);
      if (m != nullptr && std::holds_alternative<control::NodeError>(*m)) return true;
    }
    return false;
  }
};

const FixedRgb kBackground{1ll << 32, 1ll << 31, 1ll << 30};

}  // namespace

TEST_CASE("a node answers the rays that it got, under their numbers, once it has traced them") {
  Half half(ReturnsMode::kSender);
  half.receive(ray_into_nothing(0xFEDCBA98));
  half.receive(ray_into_nothing(7), BatchType::kClassRays);
  CHECK(half.answers().empty());
  CHECK(half.node.has_unfinished());
  half.work();
  auto answers = half.answers();
  REQUIRE(answers.size() == 2);
  if (answers.front().number == 7) std::swap(answers[0], answers[1]);
  CHECK(answers == std::vector<RayAnswer>{{0xFEDCBA98, true, kBackground}, {7, true, kBackground}});
}

TEST_CASE("an answer that nobody waits for ends the job, and so does any where none are due") {
  for (const ReturnsMode returns : {ReturnsMode::kFrontal, ReturnsMode::kSender}) {
    Half half(returns);
    const RayAnswer answer{3, true, {}};
    half.node.on_neighbour(encode_answers(half.stamp_of(Rank{1}), {&answer, 1}));
    CHECK(half.has_failed());
  }
}

TEST_CASE("a ray with a number in place of its pixel is refused where light goes to the frontal") {
  Half half(ReturnsMode::kFrontal);
  half.receive(ray_into_nothing(0xFEDCBA98));
  CHECK(half.has_failed());
}

TEST_CASE("a new epoch answers no ray of the one before") {
  Half half(ReturnsMode::kSender);
  half.receive(ray_into_nothing(7));
  half.tell(control::Prepare{1, 1});
  half.work();
  CHECK(half.answers().empty());
  CHECK_FALSE(half.node.is_rendering());
}
