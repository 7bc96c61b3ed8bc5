#include "frontal/parts/heartbeat.hpp"

#include "catch.hpp"

using namespace graycube;

TEST_CASE("pings are numbered, and come one in each interval") {
  Heartbeat heartbeat(2);
  CHECK(heartbeat.last_ping() == 0);
  REQUIRE(heartbeat.take_ping(100));
  CHECK_FALSE(heartbeat.take_ping(101.9));
  const auto second = heartbeat.take_ping(102);
  REQUIRE(second);
  CHECK(second->sequence == 2);
  CHECK(heartbeat.last_ping() == 2);
  CHECK(heartbeat.interval_ms() == 2000);
}

TEST_CASE(
    "who is not asked for longer than an interval was held up for all "
    "that time") {
  Heartbeat heartbeat(2);
  // Before the first time there is nothing to be held up in.
  CHECK(heartbeat.held_up_s(100) == 0);
  CHECK(heartbeat.held_up_s(102) == 0);
  CHECK(heartbeat.held_up_s(105) == 3);
  CHECK(heartbeat.held_up_s(105.5) == 0);
}
