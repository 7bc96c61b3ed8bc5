// The nodes' slices of the scene, as long as somebody may still need them: the node itself, one
// that borrows it, or a neighbour that gets a copy to help.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/hypercube.hpp"
#include "transport/message.hpp"

namespace graycube {

class SliceStock {
 public:
  struct Rules {
    /// Any node may ask for any other's.
    bool are_lent = false;
    /// Neighbours may get copies.
    bool are_copied = false;
    /// Bytes of slices, its own included, that a node has room for.
    std::uint64_t room = 0;
  };

  /// Slices by rank, or one for all.
  SliceStock(const Hypercube& cube, std::vector<SharedBytes> slices, const Rules& rules);

  /// A node's own; given away where nobody else can ask for it.
  SharedBytes take(Rank rank);
  /// To be lent; null where slices aren't, or there is no such node.
  const SharedBytes* to_lend(std::uint32_t rank) const;
  /// For a neighbour that is to help the owner; null where that has no room for it, or has one.
  const SharedBytes* to_copy(Rank owner, Rank helper);

 private:
  bool has_room(Rank helper, Rank owner) const;
  /// Whether any neighbour ever can have a copy.
  bool may_be_copied(Rank owner) const;

  Hypercube cube_;
  std::vector<SharedBytes> slices_;
  Rules rules_;
  /// By rank: of each slice, and of all that a node holds.
  std::vector<std::uint64_t> slice_bytes_, held_bytes_;
  /// By rank: bits of the neighbours whose slice it has.
  std::vector<std::uint32_t> copies_;
};

}  // namespace graycube
