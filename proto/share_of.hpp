// Which macro-regions a node holds: the same answer in the frontal and in every node.
#pragma once

#include "regions/macro_grid.hpp"
#include "topology/hypercube.hpp"

namespace graycube {

/// The regions of which Hypercube::owner_of says that `rank` owns them.
inline RegionShare share_of(const Hypercube& cube, Rank rank) {
  return {cube.columns(), cube.rows(), cube.column_of(rank), cube.row_of(rank)};
}

}  // namespace graycube
