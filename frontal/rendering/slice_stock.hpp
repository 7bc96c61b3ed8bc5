// Keeps the nodes' slices of the scene, as a node may need one at any time: the node itself or,
// when that is lost, its replacement; one that borrows the slice, or a neighbour that gets a copy
// to help.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/hypercube.hpp"
#include "transport/message.hpp"

namespace graycube {

class SliceStock {
 public:
  struct Rules {
    /// Whether any node may ask for any other node's slice.
    bool are_lent = false;
    /// Whether neighbours may get copies of each other's slices.
    bool are_copied = false;
    /// Bytes of slices, its own included, that a node has room for.
    std::uint64_t room = 0;
  };

  /// `slices` is indexed by rank, or holds one slice for all nodes.
  SliceStock(const Hypercube& cube, std::vector<SharedBytes> slices, const Rules& rules);

  /// Bytes of all nodes' own slices together.
  std::uint64_t own_bytes() const;
  /// A node's own slice.
  const SharedBytes& of(Rank rank) const;
  /// The node is lost, and with it its copies of others' slices.
  void lose(Rank rank);
  /// A slice to be lent; null if slices aren't lent, or there is no such node.
  const SharedBytes* to_lend(std::uint32_t rank) const;
  /// The owner's slice for a neighbour that is to help; null if that has no room, or has a copy.
  const SharedBytes* to_copy(Rank owner, Rank helper);

 private:
  bool has_room(Rank helper, Rank owner) const;

  Hypercube cube_;
  std::vector<SharedBytes> slices_;
  Rules rules_;
  /// Bytes of each node's slice, and of all slices that the node holds; indexed by rank.
  std::vector<std::uint64_t> slice_bytes_, held_bytes_;
  /// A mask for each node, by rank: the bits of the neighbours whose slices it has copies of.
  std::vector<std::uint32_t> copies_;
};

}  // namespace graycube
