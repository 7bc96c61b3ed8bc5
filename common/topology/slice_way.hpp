// The way on which slices come to nodes: the same answer in the frontal and in every node.
#pragma once

#include <optional>

#include "topology/node_mesh.hpp"
#include "topology/spanning_tree.hpp"

namespace graycube {

/// The tree along which slices are handed on from rank 0; nothing if each node gets its slice from
/// the frontal.
inline std::optional<SpanningTree> slice_way(const Hypercube& cube, MeshMode mesh) {
  if (cube.nodes() == 1) return std::nullopt;
  if (mesh == MeshMode::kRing) return SpanningTree(cube, SpanningTree::Shape::kChain);
  if (mesh == MeshMode::kTree) return SpanningTree(cube, SpanningTree::Shape::kBinomial);
  return std::nullopt;
}

}  // namespace graycube
