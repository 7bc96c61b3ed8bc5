#include "crossings/bsp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crossings/split_finder.hpp"
#include "csg/tree.hpp"

namespace graycube {
namespace {

/// The programs of one cell while the tree is being built.
struct CellContent {
  struct Item {
    std::uint32_t object;
    std::uint32_t first_node;
    std::uint32_t node_count;
  };
  std::vector<Item> items;
  std::vector<TreeNode> nodes;

  std::span<const TreeNode> tree(const Item& item) const {
    return {nodes.data() + item.first_node, item.node_count};
  }
};

bool is_leaf(const TreeNode& n) {
  return n.kind == TreeNode::Kind::kLeaf || n.kind == TreeNode::Kind::kInvertedLeaf;
}

}  // namespace

class BspBuilder {
 public:
  BspBuilder(const Model& model, const BspOptions& options) : model_(model), options_(options) {
    bsp_.model_ = &model;
  }

  Bsp run(std::uint32_t first_object, std::uint32_t end_object) {
    CellContent content;
    for (std::uint32_t i = first_object; i < end_object; ++i) {
      const Object& object = model_.objects[i];
      restrict_tree(model_.tree(object), i, Aabb::everything(), content);
    }
    bsp_.nodes_.emplace_back();
    const Aabb extent = finite_extent(content);
    split_off_outside(extent, std::move(content));
    link({kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour}, 0);
    return std::move(bsp_);
  }

 private:
  /// Bounds of all finite primitives of a cell's programs, empty when there is none.
  Aabb finite_extent(const CellContent& content) const {
    Aabb extent = Aabb::nothing();
    for (const TreeNode& n : content.nodes) {
      if (!is_leaf(n)) continue;
      const Aabb& bounds = model_.primitives[n.primitive].bounds;
      if (bounds.is_finite()) extent = union_of(extent, bounds);
    }
    return extent;
  }

  void restrict_tree(std::span<const TreeNode> tree, std::uint32_t object, const Aabb& grown,
                     CellContent& out) const {
    const auto first = static_cast<std::uint32_t>(out.nodes.size());
    const auto side = [&](std::uint32_t primitive) {
      return classify(model_.primitives[primitive], model_.data(), grown);
    };
    if (prune(tree, side, out.nodes) != Pruned::kVaries) return;
    out.items.push_back({object, first, static_cast<std::uint32_t>(out.nodes.size()) - first});
  }

  CellContent restrict_content(const CellContent& content, const Aabb& cell) const {
    CellContent out;
    const Aabb grown = cell.grown(model_.delta);
    for (const auto& item : content.items) {
      restrict_tree(content.tree(item), item.object, grown, out);
    }
    return out;
  }

  /// Turns node `index` into an inner node; returns the index of the lower child.
  std::uint32_t make_inner(std::uint32_t index, int axis, double at) {
    const auto child = static_cast<std::uint32_t>(bsp_.nodes_.size());
    bsp_.nodes_.resize(bsp_.nodes_.size() + 2);
    bsp_.nodes_[index] = {at, child, static_cast<std::uint8_t>(axis)};
    return child;
  }

  /// Cuts the unbounded space around the finite primitives off with six planes; the cells outside
  /// hold only unbounded primitives and are not cut further.
  void split_off_outside(const Aabb& extent, CellContent content) {
    std::uint32_t node = 0;
    Aabb cell = Aabb::everything();
    if (extent.is_empty()) {
      make_leaf(node, cell, content);
      return;
    }
    const Aabb inner = extent.grown(4 * model_.delta);
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        const double at = upper ? inner.hi[axis] : inner.lo[axis];
        const std::uint32_t child = make_inner(node, axis, at);
        Aabb outside = cell;
        (upper ? outside.lo : outside.hi)[axis] = at;
        (upper ? cell.hi : cell.lo)[axis] = at;
        make_leaf(upper ? child + 1 : child, outside, restrict_content(content, outside));
        node = upper ? child : child + 1;
      }
    }
    subdivide(node, cell, restrict_content(content, cell), 6);
  }

  /// Adds boxes of the surfaces in a cell: each primitive's bounds within `within`, its object's.
  static void add_surfaces(std::span<const TreeNode> tree, const Aabb& within, const Model& model,
                           SplitFinder& finder) {
    for (const TreeNode& n : tree) {
      if (is_leaf(n)) finder.add(intersection_of(model.primitives[n.primitive].bounds, within));
    }
  }

  void subdivide(std::uint32_t node, const Aabb& cell, CellContent content, int depth) {
    std::size_t literals = 0;
    for (const TreeNode& n : content.nodes) literals += is_leaf(n);
    if (literals == 0 || depth >= options_.max_depth) {
      make_leaf(node, cell, content);
      return;
    }
    SplitFinder finder(cell, 2 * model_.delta, options_.step_cost);
    for (const auto& item : content.items) {
      const auto tree = content.tree(item);
      add_surfaces(tree, bounds_of(tree, model_.primitives), model_, finder);
    }
    const Split split = finder.best();
    if (!(split.cost < static_cast<double>(finder.count()))) {
      make_leaf(node, cell, content);
      return;
    }
    Aabb lower = cell;
    lower.hi[split.axis] = split.at;
    Aabb upper = cell;
    upper.lo[split.axis] = split.at;
    CellContent below = restrict_content(content, lower);
    CellContent above = restrict_content(content, upper);
    content = {};
    const std::uint32_t child = make_inner(node, split.axis, split.at);
    subdivide(child, lower, std::move(below), depth + 1);
    subdivide(child + 1, upper, std::move(above), depth + 1);
  }

  void make_leaf(std::uint32_t node, const Aabb& cell, const CellContent& content) {
    BspLeaf leaf;
    leaf.cell = cell;
    leaf.first_program = static_cast<std::uint32_t>(bsp_.programs_.size());
    leaf.program_count = static_cast<std::uint32_t>(content.items.size());
    for (const auto& item : content.items) add_program(item.object, content.tree(item));
    bsp_.nodes_[node] = {0, static_cast<std::uint32_t>(bsp_.leaves_.size()), BspNode::kLeafAxis};
    bsp_.leaves_.push_back(leaf);
  }

  void add_program(std::uint32_t object, std::span<const TreeNode> tree) {
    CellProgram program;
    program.object = object;
    const bool flat = std::all_of(tree.begin() + 1, tree.end(), is_leaf);
    if (flat && tree.size() > 1) {
      program.shape = tree.front().kind == TreeNode::Kind::kAnd ? CellProgram::Shape::kAllOf
                                                                : CellProgram::Shape::kAnyOf;
      tree = tree.subspan(1);
    } else if (tree.size() > 1) {
      program.shape = CellProgram::Shape::kGeneral;
    }
    program.first_node = static_cast<std::uint32_t>(bsp_.program_nodes_.size());
    program.node_count = static_cast<std::uint32_t>(tree.size());
    for (const TreeNode& n : tree) program.literals += is_leaf(n);
    bsp_.program_nodes_.insert(bsp_.program_nodes_.end(), tree.begin(), tree.end());
    bsp_.programs_.push_back(program);
  }

  /// Gives every leaf region below `node` its neighbour links. `outer` holds the links of the cell
  /// of `node`; a link goes down as long as one child touches the whole face.
  void link(const std::array<std::uint32_t, 6>& outer, std::uint32_t node) {
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

  std::uint32_t narrowed(std::uint32_t node, int face, const Aabb& cell) const {
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

  const Model& model_;
  BspOptions options_;
  Bsp bsp_;
};

Bsp Bsp::build(const Model& model, const BspOptions& options) {
  return BspBuilder(model, options).run(0, static_cast<std::uint32_t>(model.objects.size()));
}

Bsp Bsp::build_for_object(const Model& model, std::uint32_t object, const BspOptions& options) {
  return BspBuilder(model, options).run(object, object + 1);
}

std::size_t Bsp::memory_bytes() const {
  return nodes_.capacity() * sizeof(BspNode) + leaves_.capacity() * sizeof(BspLeaf) +
         programs_.capacity() * sizeof(CellProgram) + program_nodes_.capacity() * sizeof(TreeNode);
}

}  // namespace graycube
