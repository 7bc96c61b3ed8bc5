// What the search for crossings did, for a node's report.
#pragma once

#include "crossings/mailbox.hpp"
#include "proto/messages/values.hpp"

namespace graycube {

inline void report_search(const WalkCounts& walk, control::NodeStats& stats) {
  stats.cells_visited = walk.cells_visited;
  stats.primitives_tested = walk.primitives_tested;
  stats.tests_saved = walk.tests_saved;
  stats.boxes_tested = walk.boxes_tested;
  stats.boxes_rejected = walk.boxes_rejected;
  stats.spheres_tested = walk.spheres_tested;
  stats.spheres_rejected = walk.spheres_rejected;
  stats.nodes_descended = walk.nodes_descended;
  stats.entry_links = walk.entry_links;
  stats.rays_not_shot = walk.rays_not_shot;
}

}  // namespace graycube
