#include "node/parts/neighbour_door.hpp"

#include "catch.hpp"

namespace graycube {
namespace {

Message greeting_of(Rank sender) {
  return Message::of_batch(encode_signal({0, 0, sender.value, 1, 0}, BatchType::kGreeting));
}

Secret some_secret() {
  Secret secret{};
  secret.fill(std::byte{9});
  return secret;
}

TEST_CASE("what a connection sends counts once it has greeted with the secret") {
  NeighbourDoor door(Rank{0}, some_secret());
  const Message other = Message::of_batch(encode_signal({0, 0, 1, 1, 0}, BatchType::kGoodbye));
  CHECK_FALSE(door.lets_in("a", other));
  Message greeting = greeting_of(Rank{1});
  CHECK_FALSE(door.lets_in("a", greeting));
  CHECK(door.connection_to(Rank{1}) == nullptr);
  greeting.payload = Bytes(32, std::byte{8});
  CHECK_FALSE(door.lets_in("a", greeting));
  NeighbourDoor(Rank{1}, some_secret()).sign(greeting);
  CHECK(door.lets_in("a", greeting));
  CHECK(*door.connection_to(Rank{1}) == "a");
  CHECK(door.lets_in("a", other));
  CHECK_FALSE(door.lets_in("b", other));
}

TEST_CASE("a neighbour's new process takes the place of the old one") {
  NeighbourDoor door(Rank{0}, some_secret());
  Message greeting = greeting_of(Rank{1});
  door.sign(greeting);
  REQUIRE(door.lets_in("old", greeting));
  REQUIRE(door.lets_in("new", greeting));
  CHECK(*door.connection_to(Rank{1}) == "new");
  CHECK_FALSE(door.lets_in("old", Message::of_text("batch")));
}

TEST_CASE("only greetings carry the secret") {
  const NeighbourDoor door(Rank{0}, some_secret());
  Message ack = Message::of_batch(encode_signal({0, 0, 1, 1, 0}, BatchType::kGreetingAck));
  door.sign(ack);
  CHECK(ack.payload.empty());
}

}  // namespace
}  // namespace graycube
