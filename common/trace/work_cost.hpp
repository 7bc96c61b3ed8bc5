// The cost of tracing, measured in tests of a primitive: the same in the pre-render, which predicts
// it, and on nodes, which compare the work they have done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "crossings/mailbox.hpp"
#include "subdivisions/subdivision.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Costs in units of one test of a primitive by a packet of rays: of a created ray with its shading
/// (by RayKind), and of a test that solves a quartic, in addition to the test. Fitted to the time
/// that evaluators took on 18 farms (docs/lab/2026-11-29-work-costs.md).
inline constexpr std::array<double, kRayKinds> kCreatedCost{6, 10, 38, 38};
inline constexpr double kQuarticCost = 50;

/// Costs of looking for crossings, in the same unit: of WalkCounts::visits() and tests().
struct SearchCost {
  double visit, test;
};
/// A packet's, of whose rays many share a visit (docs/lab/2026-11-29-work-costs.md).
inline constexpr SearchCost kPacketCost{7, 1};
/// A ray's alone (docs/lab/2026-11-30-subdivisions.md).
inline constexpr SearchCost kSingleRayCost{1.5, 2.5};

constexpr const SearchCost& search_cost(Subdivision way) {
  return way == Subdivision::kSurfaces ? kPacketCost : kSingleRayCost;
}

/// The cost of a piece of work that created that many rays of each kind and looked for crossings in
/// that way, as counted.
inline double work_cost(const std::array<std::uint64_t, kRayKinds>& created, const WalkCounts& walk,
                        Subdivision way) {
  const SearchCost& search = search_cost(way);
  double cost = search.visit * walk.visits() +
                kQuarticCost * static_cast<double>(walk.quartics_solved) +
                search.test * walk.tests();
  for (std::size_t k = 0; k < created.size(); ++k)
    cost += kCreatedCost[k] * static_cast<double>(created[k]);
  return cost;
}

}  // namespace graycube
