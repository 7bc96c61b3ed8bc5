#include "csg/tree.hpp"

namespace graycube {

Aabb bounds_of(std::span<const TreeNode> tree, std::span<const Primitive> primitives) {
  const TreeNode& root = tree.front();
  switch (root.kind) {
    case TreeNode::Kind::kLeaf: return primitives[root.primitive].bounds;
    case TreeNode::Kind::kInvertedLeaf: return Aabb::everything();
    default: break;
  }
  const bool is_and = root.kind == TreeNode::Kind::kAnd;
  Aabb bounds = is_and ? Aabb::everything() : Aabb::nothing();
  for (std::size_t i = 1; i < root.size; i += tree[i].size) {
    const Aabb child = bounds_of(tree.subspan(i, tree[i].size), primitives);
    bounds = is_and ? intersection_of(bounds, child) : union_of(bounds, child);
  }
  return bounds.is_empty() ? Aabb::nothing() : bounds;
}

}  // namespace graycube
