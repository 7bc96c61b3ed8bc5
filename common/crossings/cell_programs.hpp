// What leaf regions hold: the objects that have a surface in them, each as a pruned CSG program.
// Every subdivision fills and reads the same store.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "csg/model.hpp"
#include "csg/tree.hpp"

namespace graycube {

/// An object restricted to a leaf region.
struct CellProgram {
  enum class Shape : std::uint8_t { kSingle, kAllOf, kAnyOf, kGeneral };

  /// Index into Model::objects.
  std::uint32_t object = 0;
  /// Range in CellPrograms::nodes; one node for kSingle, only the literals for kAllOf and kAnyOf.
  std::uint32_t first_node = 0;
  std::uint32_t node_count = 0;
  /// Number of leaves among the nodes.
  std::uint32_t literals = 0;
  Shape shape = Shape::kSingle;
};

/// The objects' trees in one cell while a subdivision is being built, in the objects' order.
class CellContent {
 public:
  struct Item {
    std::uint32_t object;
    std::uint32_t first_node;
    std::uint32_t node_count;
  };

  /// Appends an object's tree without what `side_of(primitive)` finds outside or inside, unless it
  /// has no surface left.
  template <typename SideOf>
  void add(std::span<const TreeNode> tree, std::uint32_t object, SideOf&& side_of) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    if (prune(tree, side_of, nodes_) != Pruned::kVaries) return;
    items_.push_back({object, first, static_cast<std::uint32_t>(nodes_.size()) - first});
  }
  /// What is left of it in a part of the cell.
  template <typename SideOf>
  CellContent restricted(SideOf&& side_of) const {
    CellContent out;
    for (const Item& item : items_) out.add(tree(item), item.object, side_of);
    return out;
  }

  const std::vector<Item>& items() const { return items_; }
  std::span<const TreeNode> tree(const Item& item) const {
    return {nodes_.data() + item.first_node, item.node_count};
  }
  /// Calls f(primitive) for each leaf of the trees.
  template <typename F>
  void for_each_literal(F&& f) const {
    for (const TreeNode& n : nodes_) {
      if (n.size == 1) f(n.primitive);
    }
  }
  std::size_t literal_count() const {
    std::size_t count = 0;
    for_each_literal([&](std::uint32_t) { ++count; });
    return count;
  }

 private:
  std::vector<Item> items_;
  std::vector<TreeNode> nodes_;
};

/// The trees of objects first ≤ i < end, and of all objects, in all of space.
CellContent content_of(const Model& model, std::uint32_t first, std::uint32_t end);
CellContent content_of(const Model& model);
/// What is left of a content in a box, which is grown by the model's delta.
CellContent restricted_to(const CellContent& content, const Model& model, const Aabb& box);
/// Bounds of all finite primitives of a content; empty when there is none.
Aabb finite_extent(const CellContent& content, const Model& model);

/// The programs of one leaf region, in the objects' order.
struct ProgramRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// The programs of all leaf regions of a subdivision. The model must outlive it.
class CellPrograms {
 public:
  explicit CellPrograms(const Model& model) : model_(&model) {}

  ProgramRange add(const CellContent& content);

  const Model& model() const { return *model_; }
  const std::vector<CellProgram>& programs() const { return programs_; }
  const std::vector<TreeNode>& nodes() const { return nodes_; }
  std::size_t memory_bytes() const {
    return programs_.capacity() * sizeof(CellProgram) + nodes_.capacity() * sizeof(TreeNode);
  }

 private:
  void add_program(std::uint32_t object, std::span<const TreeNode> tree);

  const Model* model_;
  std::vector<CellProgram> programs_;
  std::vector<TreeNode> nodes_;
};

}  // namespace graycube
