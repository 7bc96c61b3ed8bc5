// How much memory and work a tree takes once its refs and repeats are expanded.
#pragma once

#include <cstdint>

#include "saturating.hpp"

namespace graycube {

/// Saturating counts: a few lines can name more than 2^64.
struct TreeCounts {
  std::uint64_t leaves = 0;
  /// Nodes of any kind; of a repeat also the products that are computed for it.
  std::uint64_t nodes = 0;
  /// Of meshes.
  std::uint64_t triangles = 0;
  /// Of polyhedra.
  std::uint64_t planes = 0;

  void add(const TreeCounts& o) {
    leaves = saturating_sum(leaves, o.leaves);
    nodes = saturating_sum(nodes, o.nodes);
    triangles = saturating_sum(triangles, o.triangles);
    planes = saturating_sum(planes, o.planes);
  }
  TreeCounts times(std::uint64_t n) const {
    return {saturating_product(leaves, n), saturating_product(nodes, n),
            saturating_product(triangles, n), saturating_product(planes, n)};
  }
};

}  // namespace graycube
