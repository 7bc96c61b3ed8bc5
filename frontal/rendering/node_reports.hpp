// The nodes' reports of what they did for a job, which come at its end.
#pragma once

#include <cstdint>
#include <vector>

#include "frontal/rendering/roll_call.hpp"
#include "proto/messages.hpp"
#include "topology/hypercube.hpp"

namespace graycube {

class NodeReports {
 public:
  explicit NodeReports(const Hypercube& cube) : came_(cube.nodes()), stats_(cube.nodes()) {
    for (std::uint32_t rank = 0; rank < cube.nodes(); ++rank) {
      stats_[rank].rank = rank;
      stats_[rank].gray = cube.label_of(Rank{rank}).value;
    }
  }

  /// Only the first report of each node counts.
  void add(const control::NodeStats& stats) {
    if (stats.rank >= stats_.size() || !came_.note(Rank{stats.rank})) return;
    stats_[stats.rank] = stats;
  }
  /// The node is lost: its report is not waited for.
  void will_not_come(Rank rank) { static_cast<void>(came_.note(rank)); }
  bool are_complete() const { return came_.is_complete(); }
  /// Indexed by rank; of a node that has not reported, only rank and label are set.
  const std::vector<control::NodeStats>& stats() const { return stats_; }

 private:
  RollCall came_;
  std::vector<control::NodeStats> stats_;
};

}  // namespace graycube
