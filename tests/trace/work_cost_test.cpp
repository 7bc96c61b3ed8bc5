// What work costs, by what was counted.
#include "trace/work_cost.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

constexpr std::array<std::uint64_t, kRayKinds> kNoRays{};

double cost_of(const WalkCounts& walk, Subdivision way) { return work_cost(kNoRays, walk, way); }

}  // namespace

TEST_CASE("work with a surface tree costs what its rays, cells, tests and quartics do") {
  WalkCounts walk;
  walk.cells_visited = 10;
  walk.primitives_tested = 100;
  walk.quartics_solved = 3;
  CHECK(work_cost({1, 2, 3, 4}, walk, Subdivision::kSurfaces) ==
        6 + 2 * 10 + 3 * 38 + 4 * 38 + 10 * 7 + 100 + 3 * 50);
}

TEST_CASE("all that a ray alone does to find its crossings costs something") {
  for (const auto count :
       {&WalkCounts::cells_visited, &WalkCounts::primitives_tested, &WalkCounts::quartics_solved,
        &WalkCounts::boxes_tested, &WalkCounts::spheres_tested, &WalkCounts::nodes_descended,
        &WalkCounts::entry_links}) {
    WalkCounts walk;
    walk.*count = 4;
    CHECK(cost_of(walk, Subdivision::kRoth) > 1);
    CHECK(cost_of(walk, Subdivision::kRoth) == cost_of(walk, Subdivision::kArnaldi));
  }
  // These tell only how the tests ended, and tests that there weren't.
  for (const auto count : {&WalkCounts::boxes_rejected, &WalkCounts::spheres_rejected,
                           &WalkCounts::tests_saved, &WalkCounts::rays_not_shot}) {
    WalkCounts walk;
    walk.*count = 4;
    CHECK(cost_of(walk, Subdivision::kRoth) == 0);
  }
}
