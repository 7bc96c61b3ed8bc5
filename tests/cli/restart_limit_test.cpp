#include "cli/farm/restart_limit.hpp"

#include "catch.hpp"

using namespace graycube;
using namespace std::chrono_literals;

TEST_CASE("a frontal is started again three times within any minute, and not a fourth time") {
  RestartLimit limit;
  const RestartLimit::Time start{};
  CHECK(limit.allows(start));
  CHECK(limit.allows(start + 10s));
  CHECK(limit.allows(start + 20s));
  CHECK_FALSE(limit.allows(start + 59s));
  CHECK(limit.allows(start + 60s));
  CHECK_FALSE(limit.allows(start + 69s));
  CHECK(limit.allows(start + 70s));
}
