#include "crossings/bsp_assembly.hpp"

#include <utility>

namespace graycube {

std::uint32_t BspAssembly::cut(std::uint32_t node, int axis, double at) {
  const auto child = static_cast<std::uint32_t>(bsp_.nodes_.size());
  bsp_.nodes_.resize(bsp_.nodes_.size() + 2);
  bsp_.nodes_[node] = {at, child, static_cast<std::uint8_t>(axis)};
  return child;
}

void BspAssembly::close(std::uint32_t node, const Aabb& cell, const CellContent& content) {
  BspLeaf leaf;
  leaf.cell = cell;
  const ProgramRange range = bsp_.store_.add(content);
  leaf.first_program = range.first;
  leaf.program_count = range.count;
  bsp_.nodes_[node] = {0, static_cast<std::uint32_t>(bsp_.leaves_.size()), BspNode::kLeafAxis};
  bsp_.leaves_.push_back(leaf);
}

Bsp BspAssembly::finish() {
  link({kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour}, 0);
  return std::move(bsp_);
}

/// Gives every leaf region below `node` its neighbour links. `outer` holds the links of the cell
/// of `node`; a link goes down as long as one child touches the whole face.
void BspAssembly::link(const std::array<std::uint32_t, 6>& outer, std::uint32_t node) {
  const BspNode n = bsp_.nodes_[node];
  if (n.axis == BspNode::kLeafAxis) {
    BspLeaf& leaf = bsp_.leaves_[n.child];
    for (std::size_t face = 0; face < 6; ++face) {
      leaf.neighbour[face] = narrowed(outer[face], static_cast<int>(face), leaf.cell);
    }
    return;
  }
  auto lower = outer;
  auto upper = outer;
  lower[static_cast<std::size_t>(n.axis * 2 + 1)] = n.child + 1;
  upper[static_cast<std::size_t>(n.axis * 2)] = n.child;
  link(lower, n.child);
  link(upper, n.child + 1);
}

std::uint32_t BspAssembly::narrowed(std::uint32_t node, int face, const Aabb& cell) const {
  while (node != kNoNeighbour && bsp_.nodes_[node].axis != BspNode::kLeafAxis) {
    const BspNode& n = bsp_.nodes_[node];
    if (n.axis == face / 2) {
      // Seen through an upper face the near child is the lower one, and the other way round.
      node = face % 2 == 1 ? n.child : n.child + 1;
    } else if (cell.hi[n.axis] <= n.split) {
      node = n.child;
    } else if (cell.lo[n.axis] >= n.split) {
      node = n.child + 1;
    } else {
      break;
    }
  }
  return node;
}

}  // namespace graycube
