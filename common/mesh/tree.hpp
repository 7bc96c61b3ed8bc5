// The hierarchy of boxes over a mesh's triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/wide_node.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// The corners of up to four triangles, as arrays indexed by corner, axis and place. Unused places
/// have three equal corners.
struct alignas(32) TriangleBlock {
  static constexpr std::size_t kWidth = 4;
  std::array<std::array<std::array<double, kWidth>, 3>, 3> corners;

  Vec3 corner(std::size_t place, std::size_t which) const {
    const auto& c = corners[which];
    return {c[0][place], c[1][place], c[2][place]};
  }
};

/// A hierarchy whose items are blocks, by their index. Immutable once built.
class MeshTree {
 public:
  MeshTree() = default;
  explicit MeshTree(const TriangleMesh& mesh);

  /// Entries of a walk's stack; a node leaves at most seven behind on each level.
  static constexpr std::size_t kMaxStack = 512;

  const std::vector<WideNode>& nodes() const { return nodes_; }
  const std::vector<TriangleBlock>& blocks() const { return blocks_; }
  /// The plane of another solid in which a triangle lies, null for its own; numbered as
  /// MeshCut::triangle.
  const Plane* plane_of(std::uint32_t triangle) const {
    if (plane_of_.empty() || plane_of_[triangle] == TriangleMesh::kOwnPlane) [[likely]]
      return nullptr;
    return &planes_[plane_of_[triangle]];
  }
  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(WideNode) + blocks_.size() * sizeof(TriangleBlock) +
           planes_.size() * sizeof(Plane) + plane_of_.size() * sizeof(std::uint32_t);
  }

  /// Whether any triangle may touch the box; conservative.
  bool may_touch(const Aabb& box) const;

 private:
  friend class MeshTreeBuilder;
  std::vector<WideNode> nodes_;
  std::vector<TriangleBlock> blocks_;
  std::vector<Plane> planes_;
  /// Index in planes_ of the plane of each place in the blocks; empty if all are triangles' own.
  std::vector<std::uint32_t> plane_of_;
};

}  // namespace graycube
