// CSG trees in negation normal form, as preorder arrays: bounds, membership, pruning.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

/// What is left of a tree in a cell: a constant, or a tree that has a surface there.
enum class Pruned : std::uint8_t { kNothing, kEverything, kVaries };

/// Appends to `out` the tree restricted to a cell: `side_of(primitive)` gives each leaf's CellSide,
/// constants are folded, single children replace their parent, nested nodes of one kind merge; the
/// order of children stays. Appends nothing when the result is a constant.
template <typename SideOf>
Pruned prune(std::span<const TreeNode> tree, SideOf&& side_of, std::vector<TreeNode>& out) {
  const TreeNode& root = tree.front();
  using Kind = TreeNode::Kind;
  if (root.kind == Kind::kLeaf || root.kind == Kind::kInvertedLeaf) {
    const CellSide side = side_of(root.primitive);
    if (side == CellSide::kCrosses) {
      out.push_back(root);
      return Pruned::kVaries;
    }
    const bool inside = (side == CellSide::kInside) == (root.kind == Kind::kLeaf);
    return inside ? Pruned::kEverything : Pruned::kNothing;
  }
  const Pruned absorbing = root.kind == Kind::kAnd ? Pruned::kNothing : Pruned::kEverything;
  const Pruned neutral = root.kind == Kind::kAnd ? Pruned::kEverything : Pruned::kNothing;
  const std::size_t start = out.size();
  out.push_back(root);
  std::size_t kept = 0;
  for (std::size_t i = 1; i < root.size;) {
    const std::uint32_t size = tree[i].size;
    const std::size_t child = out.size();
    const Pruned result = prune(tree.subspan(i, size), side_of, out);
    i += size;
    if (result == absorbing) {
      out.resize(start);
      return absorbing;
    }
    if (result != Pruned::kVaries) continue;
    ++kept;
    if (out[child].kind == root.kind) {
      out.erase(out.begin() + static_cast<std::ptrdiff_t>(child));
      ++kept;  // a merged node has two children at least
    }
  }
  if (kept == 0) {
    out.resize(start);
    return neutral;
  }
  if (kept == 1) {
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(start));
  } else {
    out[start].size = static_cast<std::uint32_t>(out.size() - start);
  }
  return Pruned::kVaries;
}

/// Membership of the whole tree, given each leaf's: `is_inside(primitive)`.
template <typename IsInside>
bool evaluate(std::span<const TreeNode> tree, IsInside&& is_inside) {
  const TreeNode& root = tree.front();
  switch (root.kind) {
    case TreeNode::Kind::kLeaf: return is_inside(root.primitive);
    case TreeNode::Kind::kInvertedLeaf: return !is_inside(root.primitive);
    default: break;
  }
  const bool is_and = root.kind == TreeNode::Kind::kAnd;
  for (std::size_t i = 1; i < root.size; i += tree[i].size) {
    if (evaluate(tree.subspan(i, tree[i].size), is_inside) != is_and) return !is_and;
  }
  return is_and;
}

/// Encloses every point of the tree.
Aabb bounds_of(std::span<const TreeNode> tree, std::span<const Primitive> primitives);

}  // namespace graycube
