#include "frontal/rendering/roll_call.hpp"

#include "catch.hpp"
#include "frontal/rendering/node_reports.hpp"

using namespace graycube;

TEST_CASE("a roll call is complete when each has answered, however often") {
  RollCall call(3);
  CHECK(call.note(Rank{0}));
  CHECK_FALSE(call.note(Rank{0}));
  CHECK(call.note(Rank{2}));
  CHECK_FALSE(call.is_complete());
  CHECK(call.note(Rank{1}));
  CHECK(call.is_complete());
}

TEST_CASE(
    "of a node's reports the first counts, and of one that hasn't "
    "reported is known who it is") {
  const Hypercube cube = *Hypercube::of_size(4);
  NodeReports reports(cube);
  control::NodeStats stats;
  stats.rank = 2;
  stats.primary = 5;
  reports.add(stats);
  stats.primary = 6;
  reports.add(stats);
  stats.rank = 4;
  reports.add(stats);
  CHECK_FALSE(reports.are_complete());
  REQUIRE(reports.stats().size() == 4);
  CHECK(reports.stats()[2].primary == 5);
  for (std::uint32_t rank : {0u, 1u, 3u}) {
    CHECK(reports.stats()[rank].rank == rank);
    CHECK(reports.stats()[rank].gray == cube.label_of(Rank{rank}).value);
    stats.rank = rank;
    reports.add(stats);
  }
  CHECK(reports.are_complete());
}
