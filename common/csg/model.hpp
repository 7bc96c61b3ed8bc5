// The compiled scene, or the part of it that one macro-region needs: leaves expanded and in world
// coordinates, trees in negation normal form. This is what the frontal sends to a node.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "csg/primitive.hpp"
#include "shading/material.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// One node of a CSG tree in preorder. Differences and complements are gone: A − B is A ∧ ¬B,
/// negations stand at the leaves. Children keep the order of the scene file; nested nodes of one
/// kind are merged.
struct TreeNode {
  enum class Kind : std::uint8_t { kAnd, kOr, kLeaf, kInvertedLeaf };
  Kind kind = Kind::kLeaf;
  /// Leaves: index into Model::primitives.
  std::uint32_t primitive = 0;
  /// Number of nodes of the subtree, this one included: the next sibling is `size` further.
  std::uint32_t size = 1;

  friend bool operator==(const TreeNode&, const TreeNode&) = default;
};

struct Object {
  /// 0-based position in the scene file; decides ties. Kept when a model is restricted.
  std::uint32_t id = 0;
  std::uint32_t first_node = 0;
  std::uint32_t node_count = 0;
  /// Encloses every point of the object.
  Aabb bounds;

  friend bool operator==(const Object&, const Object&) = default;
};

struct Model {
  RenderSettings settings;
  /// Cells and macro-regions are grown by this much when primitives are classified against them:
  /// 1e-9 × the largest coordinate of finite boxes, eye and lights (design section 8, rule 1).
  double delta = 0;
  std::vector<Material> materials;
  std::vector<Primitive> primitives;
  std::vector<Plane> planes;
  std::vector<Mesh> meshes;
  std::vector<Outline> outlines;
  std::vector<TreeNode> nodes;
  std::vector<Object> objects;

  PrimitiveData data() const { return {planes, meshes, outlines}; }
  std::span<const TreeNode> tree(const Object& object) const {
    return {nodes.data() + object.first_node, object.node_count};
  }
  friend bool operator==(const Model&, const Model&) = default;
};

}  // namespace graycube
