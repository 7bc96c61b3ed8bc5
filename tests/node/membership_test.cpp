#include "node/parts/membership.hpp"

#include "catch.hpp"
#include "node/node.hpp"
#include "proto/control.hpp"

using namespace graycube;

namespace {

control::Welcome welcome(std::uint32_t nodes, std::vector<std::string> endpoints) {
  return {nodes, "test", std::move(endpoints), 1000};
}

Membership second_of_four() {
  Membership m({Rank{1}, 7, 100, "ipc://here", 1, "test"});
  REQUIRE(m.join(welcome(4, {"a", "b", "c", "d"})));
  return m;
}

void tell(Node& node, const ControlMessage& message) {
  node.on_frontal(Message::of_text(encode(message)));
}

}  // namespace

TEST_CASE("a welcome to a farm that has no such node, or tells of another number, is refused") {
  Membership m({Rank{5}, 7, 100, "ipc://here", 1, "test"});
  CHECK_FALSE(m.join(welcome(4, {"a", "b", "c", "d"})));
  CHECK_FALSE(m.join(welcome(8, {"a", "b"})));
  CHECK_FALSE(m.join(welcome(6, std::vector<std::string>(6, "a"))));
  CHECK_FALSE(m.has_joined());
}

TEST_CASE("of two neighbours one greets the other, as soon as it can be reached") {
  const Hypercube cube = *Hypercube::of_size(4);
  for (std::uint32_t rank = 0; rank < 4; ++rank) {
    Membership m({Rank{rank}, 7, 100, "ipc://here", 1, "test"});
    REQUIRE(m.join(welcome(4, {"a", "b", "c", ""})));
    for (std::uint32_t bit = 0; bit < 2; ++bit) {
      const Rank peer = cube.neighbour(Rank{rank}, bit);
      CHECK(m.is_to_greet(bit) == (rank < peer.value && peer.value != 3));
    }
  }
}

TEST_CASE("a node is linked when all neighbours have greeted, and stays it when others are new") {
  Membership m = second_of_four();
  m.has_greeted(0);
  CHECK_FALSE(m.have_all_greeted());
  m.has_greeted(1);
  CHECK(m.have_all_greeted());
  REQUIRE(m.join(welcome(4, {"a", "b", "c", "e"})));
  CHECK(m.have_all_greeted());
}

TEST_CASE("batches of another job, epoch or process are not of now") {
  Membership m = second_of_four();
  m.begin(3, 0);
  BatchStamp stamp{3, 0, 2, 9, 0};
  CHECK(m.is_of_now(stamp));
  m.accept_only({7, 7, 8, 7});
  CHECK_FALSE(m.is_of_now(stamp));
  stamp.incarnation = 8;
  CHECK(m.is_of_now(stamp));
  m.begin_epoch(1);
  CHECK_FALSE(m.is_of_now(stamp));
  stamp.epoch = 1;
  CHECK(m.is_of_now(stamp));
  // The processes of the next job are not known yet.
  m.begin(4, 0);
  CHECK(m.is_of_now({4, 0, 2, 9, 0}));
}

TEST_CASE("greetings that come before the welcome are kept, no more than there can be links") {
  Membership m({Rank{1}, 7, 100, "ipc://here", 1, "test"});
  for (std::uint32_t i = 0; i < 2 * kMaxDimension; ++i) m.keep_early(Bytes(i + 1));
  const auto kept = m.take_early();
  REQUIRE(kept.size() == kMaxDimension);
  CHECK(kept.front().size() == 1);
  CHECK(m.take_early().empty());
}

TEST_CASE("a node hands out whom its process is to be once, also before it knows the farm") {
  Node node({Rank{2}, 7, 1, "ipc://here", 1, "test"});
  tell(node, control::Host{3, 11});
  CHECK(node.take_guests() == std::vector{control::Host{3, 11}});
  CHECK(node.take_guests().empty());
}

TEST_CASE("a node is not its own guest") {
  Node node({Rank{2}, 7, 1, "ipc://here", 1, "test"});
  tell(node, control::Host{2, 11});
  CHECK(node.take_guests().empty());
}
