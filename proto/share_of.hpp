// Which macro-regions a node holds: the same answer in the frontal and in every node.
#pragma once

#include "regions/macro_grid.hpp"
#include "topology/node_mesh.hpp"

namespace graycube {

/// The regions of which NodeMesh::owner_of says that `rank` owns them.
inline RegionShare share_of(const NodeMesh& mesh, Rank rank) {
  const NodeMesh::Place place = mesh.place_of(rank);
  return {mesh.columns(), mesh.rows(), place.column, place.row, mesh.slabs(), place.slab};
}

}  // namespace graycube
