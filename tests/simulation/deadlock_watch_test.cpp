#include "frontal/rendering/deadlock_watch.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

/// Two nodes whose evaluators each hold a ray for the other.
struct Pair {
  DeadlockWatch watch{*Hypercube::of_size(2)};
  control::WaitReport reports[2];

  Pair() {
    for (auto& r : reports) {
      r.job = 1;
      r.is_stalled = true;
      r.moves = 5;
      r.granted = {300};
      r.received = {300};
    }
  }
  /// Both answer a ping, before the one numbered `last_ping` + 1 is sent.
  std::vector<Rank> answer(std::uint64_t ping, std::uint64_t last_ping) {
    std::vector<Rank> cycle;
    for (std::uint32_t rank = 0; rank < 2; ++rank) {
      reports[rank].ping = ping;
      cycle = watch.add(Rank{rank}, reports[rank], last_ping);
    }
    return cycle;
  }
};

}  // namespace

TEST_CASE("two nodes that wait for each other twice over are a cycle") {
  Pair p;
  CHECK(p.answer(1, 1).empty());
  CHECK(p.answer(2, 2) == std::vector{Rank{0}, Rank{1}});
  CHECK(p.watch.stalled() == 2);
}

TEST_CASE("answers to a ping sent before the others had all come prove nothing") {
  Pair p;
  CHECK(p.answer(1, 3).empty());
  CHECK(p.answer(2, 3).empty());
  CHECK(p.answer(3, 3).empty());
  CHECK_FALSE(p.answer(4, 4).empty());
}

TEST_CASE("a node that moved meanwhile is no part of a cycle") {
  Pair p;
  CHECK(p.answer(1, 1).empty());
  ++p.reports[1].moves;
  CHECK(p.answer(2, 2).empty());
  CHECK_FALSE(p.answer(3, 3).empty());
}

TEST_CASE("room that is on its way ends a wait") {
  Pair p;
  p.reports[1].granted = {400};
  CHECK(p.answer(1, 1).empty());
  CHECK(p.answer(2, 2).empty());
  p.reports[0].received = {400};
  CHECK(p.answer(3, 3).empty());
  CHECK_FALSE(p.answer(4, 4).empty());
}

TEST_CASE("a node that waits for one that doesn't is no deadlock") {
  Pair p;
  p.reports[0].is_stalled = false;
  CHECK(p.answer(1, 1).empty());
  CHECK(p.answer(2, 2).empty());
}

TEST_CASE("a report of other links than the hypercube's counts for nothing") {
  Pair p;
  p.reports[0].granted = {};
  CHECK(p.answer(1, 1).empty());
  CHECK(p.answer(2, 2).empty());
}
