// A hierarchy of boxes around all surfaces of the objects that are foreign to a node: that it does
// not hold whole. A ray that meets none of the boxes, on its way from the node's macro-regions to
// its first crossing with what the node holds, is finished there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "crossings/ray_packet.hpp"
#include "crossings/surface_tree.hpp"
#include "geometry/wide_node.hpp"
#include "regions/restrict.hpp"

namespace graycube {

class ForeignBounds {
 public:
  /// The first node is the root, children come behind their parents, and no way down is longer than
  /// SurfaceTree::kMaxDepth.
  explicit ForeignBounds(std::vector<WideNode> nodes) : nodes_(std::move(nodes)) {}

  /// Bit i of the result tells whether ray i may meet something foreign at t0 ≤ t ≤ t1; 0 ≤ t0.
  RayPacket::Mask may_meet(const RayPacket& packet, TreeScratch& scratch) const;

  const std::vector<WideNode>& nodes() const { return nodes_; }
  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(WideNode); }

 private:
  std::vector<WideNode> nodes_;
};

/// Makes foreign bounds out of the tree of the whole scene, which must outlive it.
class ForeignBoundsMaker {
 public:
  explicit ForeignBoundsMaker(const SurfaceTree& whole);

  /// Bounds of all objects that `contents` do not hold whole; if they hold a part of an object,
  /// bounds of the whole of it, since the part has other surfaces. Boxes near each other are merged
  /// until all take at most `most_bytes`. Nothing when some foreign object is unbounded.
  std::optional<ForeignBounds> bounds(const ModelContents& contents, std::size_t most_bytes) const;

 private:
  const SurfaceTree& tree_;
  /// The number of items below each node of the tree.
  std::vector<std::uint32_t> items_;
};

}  // namespace graycube
