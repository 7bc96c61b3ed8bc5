#include "frontal/parts/node_registry.hpp"

#include "catch.hpp"
#include "frontal/sent_post.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr double kSilence_s = 10, kStart_s = 40;

bool is_not_slow(Rank, std::uint64_t) { return false; }

control::Hello hello(const NodeRegistry::Process& process) {
  return {process.rank.value,
          4000 + process.incarnation,
          process.incarnation,
          "ipc://" + std::to_string(process.rank.value),
          2,
          "test"};
}

/// A registry of four nodes, and the processes that it has asked for.
struct Four {
  NodeRegistry nodes{*Hypercube::of_size(4), {kSilence_s, kStart_s}};
  std::vector<NodeRegistry::Process> processes = nodes.take_starts();

  void all_say_hello(double now_s) {
    for (const auto& p : processes)
      REQUIRE_FALSE(nodes.hello(peer_of(p.rank.value), hello(p), now_s));
  }
};

}  // namespace

TEST_CASE(
    "every rank gets a process with a number of its own, and all are "
    "here after their hello") {
  Four four;
  REQUIRE(four.processes.size() == 4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    CHECK(four.processes[i].rank == Rank{i});
    CHECK(four.processes[i].incarnation == i + 1);
    CHECK_FALSE(four.nodes.all_here());
    CHECK_FALSE(four.nodes.rank_of(peer_of(i)));
    CHECK_FALSE(four.nodes.hello(peer_of(i), hello(four.processes[i]), 1));
    CHECK(four.nodes.rank_of(peer_of(i)) == Rank{i});
  }
  CHECK(four.nodes.all_here());
  CHECK(four.nodes.endpoints() ==
        std::vector<std::string>{"ipc://0", "ipc://1", "ipc://2", "ipc://3"});
  CHECK(four.nodes.incarnations() == std::vector<std::uint32_t>{1, 2, 3, 4});
}

TEST_CASE(
    "a hello of a rank that there isn't, or of another process than was "
    "started, is refused") {
  Four four;
  control::Hello other = hello(four.processes[1]);
  other.incarnation += 100;
  auto refusal = four.nodes.hello("x", other, 1);
  REQUIRE(refusal);
  CHECK(refusal->where == "incarnation");
  other.rank = 4;
  refusal = four.nodes.hello("x", other, 1);
  REQUIRE(refusal);
  CHECK(refusal->where == "rank");
  CHECK_FALSE(four.nodes.rank_of("x"));
}

TEST_CASE(
    "a node that is silent for too long is to be ended, unless nobody "
    "could hear it") {
  Four four;
  four.all_say_hello(100);
  CHECK(four.nodes.take_silent(100 + kSilence_s - 0.1, is_not_slow).empty());
  four.nodes.heard(Rank{2}, 105);
  four.nodes.was_held_up(3);
  CHECK(four.nodes.take_silent(100 + kSilence_s, is_not_slow).empty());
  CHECK(four.nodes.take_silent(103 + kSilence_s, is_not_slow) ==
        std::vector{Rank{0}, Rank{1}, Rank{3}});
  const auto kills = four.nodes.take_kills();
  REQUIRE(kills.size() == 3);
  CHECK(kills[2].rank == Rank{3});
  CHECK(kills[2].incarnation == 4);
}

TEST_CASE(
    "a lost node is unknown from then on, and another process takes its "
    "place") {
  Four four;
  four.all_say_hello(1);
  const auto lost = four.nodes.lose(Rank{2}, 103);
  CHECK(lost.name == "node 2 (process 4003)");
  CHECK_FALSE(lost.is_hopeless);
  CHECK_FALSE(four.nodes.rank_of(peer_of(2)));
  four.nodes.start(Rank{2}, 2);
  CHECK_FALSE(four.nodes.all_here());
  const auto starts = four.nodes.take_starts();
  REQUIRE(starts.size() == 1);
  CHECK(starts.front().incarnation == 5);
  CHECK(four.nodes.is_current(starts.front()));
  CHECK_FALSE(four.nodes.is_current(four.processes[2]));
  // A message of the process before comes too late.
  CHECK(four.nodes.hello("late", hello(four.processes[2]), 3));
}

TEST_CASE(
    "starting is hopeless when processes end before their hello, many in "
    "a row") {
  Four four;
  for (unsigned i = 1; i < kMaxFailedStarts; ++i) {
    const auto lost = four.nodes.lose(Rank{1}, 103);
    CHECK(lost.name == "node 1");
    CHECK_FALSE(lost.is_hopeless);
    four.nodes.start(Rank{1}, i);
  }
  SECTION("so many") { CHECK(four.nodes.lose(Rank{1}, 103).is_hopeless); }
  SECTION("but one that says hello is a new hope") {
    CHECK_FALSE(four.nodes.hello(peer_of(0), hello(four.processes[0]), 9));
    CHECK_FALSE(four.nodes.lose(Rank{1}, 103).is_hopeless);
  }
}

TEST_CASE("who is here is listed as idle or busy, the others as starting") {
  Four four;
  CHECK_FALSE(four.nodes.hello("a", hello(four.processes[1]), 1));
  for (const bool are_busy : {false, true}) {
    const auto list = four.nodes.list(are_busy).nodes;
    REQUIRE(list.size() == 4);
    CHECK(list[0].state == NodeState::kStarting);
    CHECK(list[1].state == (are_busy ? NodeState::kBusy : NodeState::kIdle));
    CHECK(list[1].pid == 4002);
    CHECK(list[1].threads == 2);
    CHECK(list[1].endpoint == "ipc://1");
    CHECK(list[2].gray == Hypercube::of_size(4)->label_of(Rank{2}).value);
  }
}

TEST_CASE("all have left when the last has") {
  Four four;
  for (std::uint32_t rank = 0; rank < 4; ++rank) {
    CHECK_FALSE(four.nodes.all_left());
    four.nodes.has_left(Rank{rank});
  }
  CHECK(four.nodes.all_left());
}

TEST_CASE("a silent node whose process could run is given more time, but not for ever") {
  Four four;
  four.all_say_hello(100);
  // The processes of all but node 2 are stopped.
  const auto is_slow = [](Rank, std::uint64_t pid) { return pid == 4003; };
  CHECK(four.nodes.take_silent(100 + kSilence_s, is_slow) ==
        std::vector{Rank{0}, Rank{1}, Rank{3}});
  const double end_s = 100 + kPatienceWithSlow * kSilence_s;
  for (const std::uint32_t rank : {0u, 1u, 3u}) four.nodes.heard(Rank{rank}, end_s);
  CHECK(four.nodes.take_silent(end_s - 1, is_slow).empty());
  CHECK(four.nodes.take_silent(end_s, is_slow) == std::vector{Rank{2}});
}

TEST_CASE("a node that can't be started gets a place in a process that has few, a neighbour's") {
  Four four;
  four.all_say_hello(1);
  // Of this cube's nodes 1 and 3 are the neighbours of node 2.
  const Hypercube cube = *Hypercube::of_size(4);
  REQUIRE_FALSE(cube.link_between(Rank{2}, Rank{0}));
  four.nodes.lose(Rank{2}, 2);
  const auto first = four.nodes.host(Rank{2}, 2);
  REQUIRE(first);
  CHECK(first->host.rank == Rank{1});
  CHECK(first->host.incarnation == 2);
  CHECK(first->guest.incarnation == 5);
  CHECK(four.nodes.list(false).nodes[2].pid == 4002);
  CHECK(four.nodes.in_process_of(Rank{1}) == std::vector{Rank{1}, Rank{2}});
  CHECK(four.nodes.in_process_of(Rank{2}) == std::vector{Rank{2}, Rank{1}});
  CHECK(four.nodes.in_process_of(Rank{0}) == std::vector{Rank{0}});
  // Node 1 is a neighbour of node 0, too, but its process has two nodes already.
  four.nodes.lose(Rank{0}, 3);
  const auto second = four.nodes.host(Rank{0}, 3);
  REQUIRE(second);
  CHECK(second->host.rank == Rank{3});
  CHECK(four.nodes.take_hostings().size() == 2);
}

TEST_CASE("without a farm that was whole, or anybody who is here, there is no host") {
  Four four;
  for (std::uint32_t i = 0; i < 3; ++i)
    REQUIRE_FALSE(four.nodes.hello(peer_of(i), hello(four.processes[i]), 1));
  CHECK_FALSE(four.nodes.host(Rank{3}, 2));
  REQUIRE_FALSE(four.nodes.hello(peer_of(3), hello(four.processes[3]), 1));
  for (std::uint32_t i = 0; i < 4; ++i) {
    four.nodes.lose(Rank{i}, 2);
    four.nodes.start(Rank{i}, 2);
  }
  CHECK_FALSE(four.nodes.host(Rank{3}, 2));
}

TEST_CASE("after many guests in a row that never said hello nobody is asked to be a host") {
  Four four;
  four.all_say_hello(1);
  for (unsigned i = 0; i < kMaxFailedStarts; ++i) {
    CHECK_FALSE(four.nodes.lose(Rank{3}, 2).is_hopeless);
    REQUIRE(four.nodes.host(Rank{3}, 2));
  }
  four.nodes.lose(Rank{3}, 2);
  CHECK_FALSE(four.nodes.host(Rank{3}, 2));
}

TEST_CASE("a silent process that is several nodes is ended once") {
  Four four;
  four.all_say_hello(100);
  four.nodes.lose(Rank{3}, 100);
  const auto hosting = four.nodes.host(Rank{3}, 100);
  REQUIRE(hosting);
  control::Hello as_guest = hello(hosting->guest);
  as_guest.pid = 4000 + hosting->host.incarnation;
  REQUIRE_FALSE(four.nodes.hello("guest", as_guest, 100));
  for (std::uint32_t rank = 0; rank < 3; ++rank) {
    if (Rank{rank} != hosting->host.rank) four.nodes.heard(Rank{rank}, 100 + kSilence_s);
  }
  CHECK(four.nodes.take_silent(100 + kSilence_s, is_not_slow) == std::vector{hosting->host.rank});
  CHECK(four.nodes.take_kills().size() == 1);
}

TEST_CASE("processes of two hosts that have the same id are two") {
  Four four;
  four.nodes.set_host(Rank{1}, 1);
  four.nodes.set_host(Rank{2}, 2);
  control::Hello one = hello(four.processes[1]), other = hello(four.processes[2]);
  one.pid = other.pid = 77;
  REQUIRE_FALSE(four.nodes.hello(peer_of(1), one, 1));
  REQUIRE_FALSE(four.nodes.hello(peer_of(2), other, 1));
  CHECK(four.nodes.in_process_of(Rank{1}) == std::vector{Rank{1}});
  four.nodes.set_host(Rank{2}, 1);
  CHECK(four.nodes.in_process_of(Rank{1}) == std::vector{Rank{1}, Rank{2}});
}
