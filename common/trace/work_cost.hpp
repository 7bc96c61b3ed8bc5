// The cost of tracing, measured in tests of a primitive: the same in the pre-render, which predicts
// it, and on nodes, which compare the work they have done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "crossings/mailbox.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Costs in units of one test of a primitive: of a created ray with its shading (by RayKind), of a
/// cell that a packet visits, and of a test that solves a quartic, in addition to the test. Fitted
/// to the time that evaluators took on 18 farms (docs/lab/2026-11-29-work-costs.md).
inline constexpr std::array<double, kRayKinds> kCreatedCost{6, 10, 38, 38};
inline constexpr double kCellCost = 7;
inline constexpr double kQuarticCost = 50;

/// The cost of a piece of work that created that many rays of each kind and walked as counted.
inline double work_cost(const std::array<std::uint64_t, kRayKinds>& created,
                        const WalkCounts& walk) {
  double cost = kCellCost * static_cast<double>(walk.cells_visited) +
                kQuarticCost * static_cast<double>(walk.quartics_solved) +
                static_cast<double>(walk.primitives_tested);
  for (std::size_t k = 0; k < created.size(); ++k)
    cost += kCreatedCost[k] * static_cast<double>(created[k]);
  return cost;
}

}  // namespace graycube
