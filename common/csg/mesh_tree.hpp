// The hierarchy of boxes over a mesh's triangles: eight children a node.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/triangle_mesh.hpp"
#include "geometry/aabb.hpp"
#include "geometry/culling_ray.hpp"

namespace graycube {

/// Up to eight boxes side by side. Unused places hold empty boxes.
struct alignas(64) MeshTreeNode {
  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kLeafFlag = 0x80000000u;
  static constexpr std::uint32_t kCountShift = 28;

  /// [0]: lower, [1]: upper sides, by axis.
  std::array<std::array<std::array<float, kWidth>, 3>, 2> planes{};
  /// Inner: index of a node; with kLeafFlag: first triangle, and from bit kCountShift on their number less one.
  std::array<std::uint32_t, kWidth> child{};
};

class MeshTree {
 public:
  static constexpr std::size_t kMaxLeafTriangles = 4;
  static constexpr std::size_t kMaxStack = 512;
  static_assert(kMaxMeshTriangles <= 1u << MeshTreeNode::kCountShift);

  MeshTree() = default;
  explicit MeshTree(const TriangleMesh& mesh);

  /// All triangles, in the order in which leaves name them.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(MeshTreeNode) + triangles_.size() * sizeof(Triangle);
  }

  /// Calls visit(first, end) for the runs of triangles whose boxes the ray may meet in [from, to], where 0 ≤ from and both
  /// carry the slack already.
  template <typename Visit>
  void along(const CullingRay& ray, float from, float to, Visit&& visit) const {
    descend([&](const MeshTreeNode& node) { return meet(node, ray, from, to); },
            [&](std::uint32_t first, std::uint32_t end) {
              visit(first, end);
              return true;
            });
  }

  /// Calls visit(first, end) for the runs of triangles whose boxes touch the box, until it returns false; false then.
  template <typename Visit>
  bool within(const Aabb& box, Visit&& visit) const {
    return descend([&](const MeshTreeNode& node) { return touching(node, box); }, visit);
  }

 private:
  friend class MeshTreeBuilder;

  /// A bit for each child that the ray may meet. Written so that compilers turn it into vector code.
  static std::uint32_t meet(const MeshTreeNode& node, const CullingRay& ray, float from, float to) {
    constexpr std::size_t kWidth = MeshTreeNode::kWidth;
    alignas(32) float near[kWidth], far[kWidth];
    for (std::size_t i = 0; i < kWidth; ++i) near[i] = from;
    for (std::size_t i = 0; i < kWidth; ++i) far[i] = to;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& near_planes = node.planes[ray.near_side[a]][a];
      const auto& far_planes = node.planes[1 - ray.near_side[a]][a];
      const float near_origin = ray.near_origin[a], near_inverse = ray.near_inverse[a];
      const float far_origin = ray.far_origin[a], far_inverse = ray.far_inverse[a];
      for (std::size_t i = 0; i < kWidth; ++i) {
        const float enter = (near_planes[i] - near_origin) * near_inverse;
        const float leave = (far_planes[i] - far_origin) * far_inverse;
        near[i] = enter > near[i] ? enter : near[i];
        far[i] = leave < far[i] ? leave : far[i];
      }
    }
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < kWidth; ++i) mask |= static_cast<std::uint32_t>(near[i] <= far[i]) << i;
    return mask;
  }

  static std::uint32_t touching(const MeshTreeNode& node, const Aabb& box);

  /// Goes down wherever children(node) has bits, until leaf(first, end) returns false; false then.
  template <typename Children, typename Leaf>
  bool descend(Children&& children, Leaf&& leaf) const {
    if (nodes_.empty()) return true;
    std::uint32_t stack[kMaxStack];
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const MeshTreeNode& node = nodes_[stack[--size]];
      for (std::uint32_t mask = children(node); mask != 0; mask &= mask - 1) {
        const std::uint32_t child = node.child[static_cast<std::size_t>(__builtin_ctz(mask))];
        if ((child & MeshTreeNode::kLeafFlag) == 0) {
          stack[size++] = child;
          continue;
        }
        const std::uint32_t first = child & ((1u << MeshTreeNode::kCountShift) - 1);
        const std::uint32_t count = ((child & ~MeshTreeNode::kLeafFlag) >> MeshTreeNode::kCountShift) + 1;
        if (!leaf(first, first + count)) return false;
      }
    }
    return true;
  }

  std::vector<MeshTreeNode> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace graycube
