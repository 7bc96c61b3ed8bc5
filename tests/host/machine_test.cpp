#include "host/machine.hpp"

#include <sched.h>

#include "catch.hpp"

using namespace graycube;

TEST_CASE("a machine tells what it has, and the same each time") {
  CHECK_FALSE(machine_name().empty());
  CHECK(locality_tag() == locality_tag());
  CHECK(locality_tag().find(':') != std::string::npos);
  CHECK(usable_cores() >= 1);
  CHECK(usable_memory_bytes() > (1u << 20));
}

TEST_CASE("cores that a process may not use don't count") {
  cpu_set_t before, one;
  REQUIRE(::sched_getaffinity(0, sizeof before, &before) == 0);
  CPU_ZERO(&one);
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (!CPU_ISSET(core, &before)) continue;
    CPU_SET(core, &one);
    break;
  }
  REQUIRE(::sched_setaffinity(0, sizeof one, &one) == 0);
  CHECK(usable_cores() == 1);
  REQUIRE(::sched_setaffinity(0, sizeof before, &before) == 0);
}
