// The hierarchy of boxes over a mesh's triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/triangle_mesh.hpp"
#include "geometry/aabb.hpp"
#include "geometry/wide_node.hpp"

namespace graycube {

/// The corners of up to four triangles, side by side by corner and axis. Unused places have three equal corners.
struct alignas(32) TriangleBlock {
  static constexpr std::size_t kWidth = 4;
  std::array<std::array<std::array<double, kWidth>, 3>, 3> corners;

  Vec3 corner(std::size_t place, std::size_t which) const {
    const auto& c = corners[which];
    return {c[0][place], c[1][place], c[2][place]};
  }
};

/// Leaves are blocks: kItemFlag and the block's index. Immutable once built.
class MeshTree {
 public:
  MeshTree() = default;
  explicit MeshTree(const TriangleMesh& mesh);

  /// Entries of a walk's stack; a node leaves at most seven behind on each level.
  static constexpr std::size_t kMaxStack = 512;

  const std::vector<WideNode>& nodes() const { return nodes_; }
  const std::vector<TriangleBlock>& blocks() const { return blocks_; }
  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(WideNode) + blocks_.size() * sizeof(TriangleBlock);
  }

  /// Conservative: may any triangle touch the box?
  bool may_touch(const Aabb& box) const;

 private:
  friend class MeshTreeBuilder;
  std::vector<WideNode> nodes_;
  std::vector<TriangleBlock> blocks_;
};

}  // namespace graycube
