// A tree of all nodes over links, rooted at rank 0: light is added up along it towards the root,
// and slices are handed on along it from there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "topology/hypercube.hpp"

namespace graycube {

class SpanningTree {
 public:
  enum class Shape : std::uint8_t {
    kBinomial,  ///< Hypercube::tree_parent: at most as deep as the hypercube has dimensions
    kChain      ///< Hypercube::ring_next without the link back to the root
  };

  SpanningTree(const Hypercube& cube, Shape shape) : cube_(cube), shape_(shape) {}

  const Hypercube& cube() const { return cube_; }
  /// Nothing for the root.
  std::optional<Rank> parent(Rank rank) const;
  std::vector<Rank> children(Rank rank) const;
  /// The child of `from` that is `to` or has it below itself; nothing if `to` isn't below `from`.
  std::optional<Rank> child_towards(Rank from, Rank to) const;
  /// All nodes but the root, those with most links between them and it first: messages to those
  /// take longest.
  std::vector<Rank> farthest_first() const;

 private:
  /// Links between the root and a node.
  std::uint32_t depth(Rank rank) const;

  Hypercube cube_;
  Shape shape_;
};

}  // namespace graycube
