#include "coordination/termination.hpp"

#include <deque>
#include <map>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include "catch.hpp"
#include "topology/hypercube.hpp"

namespace graycube {
namespace {

using Role = TerminationRing::Role;
using Outcome = Verdict::Outcome;

/// Nodes that send each other work over links, FIFO each and as slow as the dice will have it; the
/// token shares the links with the work. Every other link keeps work for `laziness` times as long
/// as the rest, so that the token goes round many times while a message is under way.
class Farm {
 public:
  Farm(std::uint32_t nodes, std::uint32_t seed, std::uint32_t rounds_until_loss)
      : cube_(*Hypercube::of_size(nodes)), engine_(seed) {
    for (std::uint32_t i = 0; i < seed % 4; ++i) laziness_ *= 8;
    for (std::uint32_t n = 0; n < nodes; ++n) {
      const Role role = n == 0 ? Role::kInitiator : Role::kMember;
      nodes_.push_back({TerminationRing(role, rounds_until_loss)});
    }
    restart();
  }

  /// All nodes start active, with `messages` of work to send among them.
  void restart(std::uint32_t messages = 40) {
    budget_ = messages;
    links_.clear();
    in_flight_ = batches_ = 0;
    holder_ = 0;
    for (Node& node : nodes_) {
      node.ring.reset();
      node.active = true;
    }
  }

  /// Lets one event happen, drawn at random.
  void step() {
    switch (engine_() % 4) {
      case 0: return work(static_cast<std::uint32_t>(engine_() % nodes_.size()));
      case 1:
      case 2: return deliver();
      default: return pass(holder_);
    }
  }

  /// Runs until there is a verdict, which must come, and come only when it is true.
  Verdict run(std::uint64_t most_steps = 4'000'000) {
    for (std::uint64_t steps = 0; !initiator().verdict(); ++steps) {
      if (steps == most_steps) FAIL("no verdict");
      step();
    }
    return *initiator().verdict();
  }

  void lose_message_of(std::uint32_t n) { nodes_[n].ring.message_sent(); }
  TerminationRing& initiator() { return nodes_[0].ring; }
  std::uint64_t batches() const { return batches_; }
  std::uint64_t messages_in_flight() const { return in_flight_; }
  bool all_passive() const {
    for (const Node& node : nodes_) {
      if (node.active) return false;
    }
    return true;
  }

 private:
  struct Work {};
  using Message = std::variant<Work, Token>;
  struct Node {
    TerminationRing ring;
    bool active = true;
  };

  void work(std::uint32_t n) {
    Node& node = nodes_[n];
    if (!node.active) return;
    if (engine_() % 3 == 0) {
      node.ring.contribution_batch_sent();
      ++batches_;
    }
    if (budget_ == 0 || cube_.dimension() == 0 || engine_() % 4 == 0) {
      node.active = false;
      return;
    }
    --budget_;
    const auto bit = static_cast<std::uint32_t>(engine_() % cube_.dimension());
    node.ring.message_sent();
    ++in_flight_;
    links_[{n, cube_.neighbour(Rank{n}, bit).value}].push_back(Work{});
  }

  void deliver() {
    if (links_.empty()) return;
    auto link = std::next(links_.begin(), static_cast<std::ptrdiff_t>(engine_() % links_.size()));
    const auto [from, to] = link->first;
    Node& node = nodes_[to];
    const bool lazy = (from * 7 + to * 13) % 4 < 2;
    const bool is_work = std::holds_alternative<Work>(link->second.front());
    if (is_work && lazy && engine_() % laziness_ != 0) return;
    if (const auto* token = std::get_if<Token>(&link->second.front())) {
      if (!node.ring.token_arrived(*token)) FAIL("a token that was due is refused");
      holder_ = to;
    } else {
      node.ring.message_received();
      node.active = true;
      --in_flight_;
    }
    link->second.pop_front();
    if (link->second.empty()) links_.erase(link);
  }

  void pass(std::uint32_t n) {
    const auto token = nodes_[n].ring.try_pass(!nodes_[n].active);
    if (token) links_[{n, cube_.ring_next(Rank{n}).value}].push_back(*token);
  }

  Hypercube cube_;
  std::mt19937 engine_;
  std::vector<Node> nodes_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::deque<Message>> links_;
  std::uint32_t budget_ = 0;
  std::uint64_t in_flight_ = 0, batches_ = 0;
  std::uint32_t holder_ = 0;  // the last node the token came to
  std::uint64_t laziness_ = 1;
};

constexpr std::uint32_t kNever = 1u << 30;

TEST_CASE("the token detects the end, and never too early, on rings of 1 to 64 nodes") {
  for (std::uint32_t seed = 0; seed < 2400; ++seed) {
    // Mostly small rings: on them the rare orders of events happen that need colour and count.
    const std::uint32_t nodes = 1u << (seed % 20 == 0 ? seed / 20 % 7 : 1 + seed / 20 % 3);
    Farm farm(nodes, seed, kNever);
    const Verdict verdict = farm.run();
    CAPTURE(seed, nodes);
    REQUIRE(farm.all_passive());
    REQUIRE(farm.messages_in_flight() == 0);
    CHECK(verdict.outcome == Outcome::kQuiet);
    CHECK(verdict.contribution_batches == farm.batches());
    CHECK(verdict.rounds >= 1);
    CHECK(verdict.hops == verdict.rounds * nodes);
  }
}

TEST_CASE("a reset ring serves the next epoch, whatever state the last one left") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    Farm farm(8, seed, kNever);
    for (std::uint32_t i = 0; i < 10 * seed; ++i) farm.step();
    farm.restart();
    const Verdict verdict = farm.run();
    CAPTURE(seed);
    REQUIRE(farm.all_passive());
    REQUIRE(farm.messages_in_flight() == 0);
    CHECK(verdict.contribution_batches == farm.batches());
  }
}

TEST_CASE("a lost message is never taken for the end, and is told apart from it") {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    // After so many equal rounds, nothing can still be under way.
    const std::uint32_t nodes = 1u << (seed % 5);
    Farm farm(nodes, seed, 200);
    farm.lose_message_of(seed % nodes);
    const Verdict verdict = farm.run();
    CAPTURE(seed);
    CHECK(verdict.outcome == Outcome::kLost);
    CHECK(verdict.missing == 1);
    CHECK(farm.all_passive());
  }
}

TEST_CASE("a ring of one goes through a round by itself") {
  TerminationRing ring(Role::kInitiator);
  ring.contribution_batch_sent(3);
  CHECK_FALSE(ring.try_pass(false));
  const auto token = ring.try_pass(true);
  REQUIRE(token);
  CHECK_FALSE(ring.try_pass(true));  // it is under way
  REQUIRE(ring.token_arrived(*token));
  CHECK_FALSE(ring.try_pass(false));
  CHECK_FALSE(ring.verdict());
  CHECK_FALSE(ring.try_pass(true));
  REQUIRE(ring.verdict());
  CHECK(*ring.verdict() == Verdict{.rounds = 1, .hops = 1, .contribution_batches = 3});
}

TEST_CASE("an initiator that may not launch judges what comes back, and launches when it may") {
  TerminationRing initiator(Role::kInitiator), member(Role::kMember);
  const auto round = [&](Token token) {
    REQUIRE(member.token_arrived(token));
    REQUIRE(initiator.token_arrived(*member.try_pass(true)));
  };
  CHECK(initiator.rounds_launched() == 0);
  CHECK_FALSE(initiator.try_pass(true, false));
  const auto first = initiator.try_pass(true);
  REQUIRE(first);
  member.message_received();
  initiator.message_sent();
  round(*first);
  CHECK_FALSE(initiator.try_pass(true, false));
  CHECK_FALSE(initiator.try_pass(false));
  CHECK_FALSE(initiator.verdict());
  const auto second = initiator.try_pass(true);
  REQUIRE(second);
  CHECK(second->round == 2);
  CHECK(second->hops == 3);
  CHECK_FALSE(initiator.try_pass(true));
  round(*second);
  // A verdict needs no further round.
  CHECK_FALSE(initiator.try_pass(true, false));
  REQUIRE(initiator.verdict());
  CHECK(initiator.verdict()->outcome == Outcome::kQuiet);
  CHECK(initiator.rounds_launched() == 2);
  CHECK(member.rounds_launched() == 0);
}

TEST_CASE("a node turns black on receipt, blackens the token once and is white again") {
  TerminationRing member(Role::kMember);
  CHECK_FALSE(member.try_pass(true));
  member.message_received();
  REQUIRE(member.token_arrived({.round = 1}));
  CHECK_FALSE(member.try_pass(false));
  CHECK(member.holds_token());
  const auto first = member.try_pass(true);
  REQUIRE(first);
  CHECK(*first == Token{.black = true, .count = -1, .round = 1, .hops = 1});
  REQUIRE(member.token_arrived({.round = 2}));
  const auto second = member.try_pass(true);
  REQUIRE(second);
  CHECK(*second == Token{.black = false, .count = -1, .round = 2, .hops = 1});
}

TEST_CASE("a node that only sends stays white but counts") {
  TerminationRing member(Role::kMember);
  member.message_sent(2);
  member.message_received(0);
  REQUIRE(member.token_arrived({.count = 5, .round = 1}));
  CHECK(member.try_pass(true) == Token{.black = false, .count = 7, .round = 1, .hops = 1});
}

TEST_CASE("a black initiator, a black token and a sum that is not zero each fail the round") {
  const auto judged = [](const Token& returned, bool receives) {
    TerminationRing ring(Role::kInitiator);
    REQUIRE(ring.try_pass(true));
    if (receives) ring.message_received();
    REQUIRE(ring.token_arrived(returned));
    const auto next = ring.try_pass(true);
    REQUIRE(next.has_value() != ring.verdict().has_value());
    if (next) {
      CHECK(*next == Token{.round = 2, .hops = returned.hops + 1});
    }
    return ring.verdict().has_value();
  };
  CHECK(judged({.round = 1, .hops = 4}, false));
  CHECK_FALSE(judged({.black = true, .round = 1, .hops = 4}, false));
  CHECK_FALSE(judged({.count = 1, .round = 1, .hops = 4}, true));
  CHECK_FALSE(judged({.count = 1, .round = 1, .hops = 4}, false));
}

TEST_CASE("two white rounds in a row with the same non-zero sum mean a loss") {
  TerminationRing ring(Role::kInitiator);
  auto token = ring.try_pass(true);
  const auto round_with = [&](bool black, std::int64_t count) {
    REQUIRE(token);
    token->black = black;
    token->count = count;
    REQUIRE(ring.token_arrived(*token));
    token = ring.try_pass(true);
  };
  round_with(false, 2);
  CHECK(ring.stalled_rounds() == 1);
  round_with(false, 1);  // another sum: something has moved
  round_with(true, 1);   // a black round between
  CHECK(ring.stalled_rounds() == 0);
  round_with(false, 1);
  CHECK_FALSE(ring.verdict());
  round_with(false, 1);
  REQUIRE(ring.verdict());
  CHECK(ring.verdict()->outcome == Outcome::kLost);
  CHECK(ring.verdict()->missing == 1);
  CHECK(ring.verdict()->rounds == 5);
  CHECK_FALSE(ring.try_pass(true));
}

TEST_CASE("tokens that cannot be due are refused") {
  TerminationRing initiator(Role::kInitiator);
  CHECK_FALSE(initiator.token_arrived({.round = 0}));  // none was launched
  REQUIRE(initiator.try_pass(true));
  CHECK_FALSE(initiator.token_arrived({.round = 2}));
  REQUIRE(initiator.token_arrived({.round = 1}));
  CHECK_FALSE(initiator.token_arrived({.round = 1}));  // twice
  TerminationRing member(Role::kMember);
  REQUIRE(member.token_arrived({.round = 1}));
  REQUIRE(member.try_pass(true));
  CHECK_FALSE(member.token_arrived({.round = 1}));
  CHECK(member.token_arrived({.round = 2}));
}

}  // namespace
}  // namespace graycube
