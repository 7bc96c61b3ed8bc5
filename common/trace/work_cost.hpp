// What tracing costs, in tests of a primitive: the same in the pre-render, which predicts it, and
// on nodes, which compare what they have done.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "crossings/mailbox.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// What things cost beside a test of a primitive: a ray that is created, by kind, with what is
/// shaded for it, a cell that a packet visits, and what a test takes longer for a quartic. Fitted
/// to the time that evaluators took on 18 farms (docs/lab/2026-11-29-work-costs.md).
inline constexpr std::array<double, kRayKinds> kCreatedCost{6, 10, 38, 38};
inline constexpr double kCellCost = 7;
inline constexpr double kQuarticCost = 50;

/// Of a piece of work in which so many rays of each kind were created.
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
