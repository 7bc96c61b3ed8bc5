#include "node/tally.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

control::NodeStats report_of(const Tally& tally) {
  control::NodeStats stats;
  tally.report(stats);
  return stats;
}

}  // namespace

TEST_CASE("what was traced adds up, each kind of ray by itself") {
  Step step;
  step.rays.created = {1, 20, 300, 4000};
  step.rays.skipped_by_horizon = 5;
  step.rounding.non_finite = 6;
  step.rounding.clamped = 7;
  Tally tally;
  WalkCounts walk{.cells_visited = 8, .primitives_tested = 9, .quartics_solved = 1};
  walk.tests_saved = 1;
  walk.boxes_tested = 2;
  walk.boxes_rejected = 3;
  walk.spheres_tested = 4;
  walk.spheres_rejected = 5;
  walk.nodes_descended = 6;
  walk.entry_links = 7;
  walk.rays_not_shot = 8;
  tally.add(step, walk);
  tally.add(step, walk);
  const control::NodeStats stats = report_of(tally);
  CHECK(stats.primary == 2);
  CHECK(stats.shadow == 40);
  CHECK(stats.reflection == 600);
  CHECK(stats.refraction == 8000);
  CHECK(stats.skipped_by_horizon == 10);
  CHECK(stats.non_finite == 12);
  CHECK(stats.clamped == 14);
  CHECK(stats.cells_visited == 16);
  CHECK(stats.primitives_tested == 18);
  CHECK(stats.tests_saved == 2);
  CHECK(stats.boxes_tested == 4);
  CHECK(stats.boxes_rejected == 6);
  CHECK(stats.spheres_tested == 8);
  CHECK(stats.spheres_rejected == 10);
  CHECK(stats.nodes_descended == 12);
  CHECK(stats.entry_links == 14);
  CHECK(stats.rays_not_shot == 16);
}

TEST_CASE("rays that come are counted, and of those that wait the most at a time") {
  Tally tally;
  tally.rays_came(30);
  tally.rays_came(12);
  tally.note_queue(9);
  tally.note_queue(42);
  tally.note_queue(0);
  CHECK(report_of(tally).rays_in == 42);
  CHECK(report_of(tally).queue_peak == 42);
}
