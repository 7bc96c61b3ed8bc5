// Sums of a run's rays on their ways between nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "figures/run_record.hpp"

namespace graycube::figures {

/// The rays that went one way across a link, all in all and in each of equal parts of the run.
struct LinkTraffic {
  Rank from, to;
  std::uint64_t rays = 0;
  std::vector<std::uint64_t> over_time;
};

/// The links that rays crossed, the busiest first; of equal ones the lower ranks first. `parts`
/// ≥ 1.
std::vector<LinkTraffic> traffic_of(const RunRecord& run, std::size_t parts);

/// The rays that each node received, by rank.
std::vector<std::uint64_t> received_by(const std::vector<LinkTraffic>& links, std::uint32_t nodes);

}  // namespace graycube::figures
