#include "crossings/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "crossings/bsp.hpp"
#include "csg/tree.hpp"
#include "geometry/culling_ray.hpp"
#include "geometry/wide_tree_builder.hpp"

namespace graycube {
namespace {

bool is_leaf(const TreeNode& n) { return n.size == 1; }

}  // namespace

class SurfaceTreeBuilder {
 public:
  SurfaceTreeBuilder(const Model& model, const SurfaceTreeOptions& options)
      : model_(model), options_(options) {
    tree_.model_ = &model;
  }

  SurfaceTree run() {
    // Most objects are one item.
    tree_.items_.reserve(model_.objects.size());
    boxes_.reserve(model_.objects.size());
    tree_.literals_.reserve(model_.primitives.size());
    for (std::uint32_t i = 0; i < model_.objects.size(); ++i) add_object(i);
    std::vector<std::uint32_t> bounded;
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].is_finite()) {
        bounded.push_back(i);
      } else {
        tree_.unbounded_.push_back(i);
      }
    }
    if (!bounded.empty()) {
      using Builder = WideTreeBuilder<SurfaceTreeBuilder>;
      // 32 levels of halves end 2³² items.
      static_assert(Builder::kMaxChosenDepth + 32 <= SurfaceTree::kMaxDepth);
      Builder(*this, tree_.nodes_).run(bounded);
      put_items_in_tree_order();
    }
    return std::move(tree_);
  }

 private:
  friend class WideTreeBuilder<SurfaceTreeBuilder>;
  using Box = Aabb;
  using Run = std::span<std::uint32_t>;
  static constexpr std::size_t kMostTogether = 1;

  /// A group needs no more slices than it has items; by far the most groups have few items.
  static std::size_t bins_for(std::size_t items) {
    return std::clamp<std::size_t>(items, 2, kMaxBins);
  }

  void add_object(std::uint32_t index) {
    const Object& object = model_.objects[index];
    const auto tree = model_.tree(object);
    const auto literals =
        static_cast<std::uint32_t>(std::count_if(tree.begin(), tree.end(), is_leaf));
    if (literals <= options_.whole_object_literals) {
      if (!object.bounds.is_empty()) add_item(index, tree, object.bounds, SurfaceItem::kAllSpace);
      return;
    }
    const Bsp cells = Bsp::build_for_object(model_, index);
    for (const BspLeaf& leaf : cells.leaves()) {
      for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
        add_cell(cells, leaf, cells.programs()[leaf.first_program + i]);
      }
    }
  }

  void add_cell(const Bsp& cells, const BspLeaf& leaf, const CellProgram& program) {
    std::vector<TreeNode> tree;
    using Shape = CellProgram::Shape;
    if (program.shape == Shape::kAllOf || program.shape == Shape::kAnyOf) {
      const auto kind = program.shape == Shape::kAllOf ? TreeNode::Kind::kAnd : TreeNode::Kind::kOr;
      tree.push_back({kind, 0, program.node_count + 1});
    }
    const auto first = cells.program_nodes().begin() + program.first_node;
    tree.insert(tree.end(), first, first + program.node_count);
    const Aabb box = intersection_of(leaf.cell, bounds_of(tree, model_.primitives));
    if (box.is_empty()) return;
    tree_.cells_.push_back(leaf.cell);
    add_item(program.object, tree, box, static_cast<std::uint32_t>(tree_.cells_.size() - 1));
  }

  void add_item(std::uint32_t object, std::span<const TreeNode> tree, const Aabb& box,
                std::uint32_t cell) {
    SurfaceItem item;
    item.object = object;
    item.cell = cell;
    item.first_literal = static_cast<std::uint32_t>(tree_.literals_.size());
    const bool is_flat = std::all_of(tree.begin() + 1, tree.end(), is_leaf);
    item.is_complement = is_flat && tree.front().kind == TreeNode::Kind::kOr;
    item.is_small = item.is_simple = true;
    for (const TreeNode& n : tree) {
      if (!is_leaf(n)) continue;
      const Primitive& p = model_.primitives[n.primitive];
      Literal literal = literal_of(n.primitive);
      literal.is_inverted = (n.kind == TreeNode::Kind::kInvertedLeaf) != item.is_complement;
      tree_.literals_.push_back(literal);
      item.is_small = item.is_small && !crossings::may_have_many_intervals(p.kind);
      item.is_simple = item.is_simple && !crossings::may_have_two_intervals(p.kind);
      item.is_opaque = item.is_opaque && !(model_.materials[p.material].transmit > 0);
    }
    item.literal_count = static_cast<std::uint32_t>(tree_.literals_.size()) - item.first_literal;
    item.is_mesh = cell == SurfaceItem::kAllSpace && item.literal_count == 1 &&
                   tree_.literals_.back().kind == PrimitiveKind::kMesh;
    item.is_small = item.is_small && item.literal_count <= crossings::kMaxFlatLiterals;
    if (!is_flat) {
      item.first_node = static_cast<std::uint32_t>(tree_.program_nodes_.size());
      item.node_count = static_cast<std::uint32_t>(tree.size());
      tree_.program_nodes_.insert(tree_.program_nodes_.end(), tree.begin(), tree.end());
      item.first_operation = static_cast<std::uint32_t>(tree_.operations_.size());
      item.is_small = item.is_small && crossings::MaskedProgram::append(tree, tree_.operations_);
    }
    tree_.items_.push_back(item);
    boxes_.push_back(box.grown(model_.delta));
  }

  Literal literal_of(std::uint32_t primitive) const {
    const Primitive& p = model_.primitives[primitive];
    Literal literal{p.v, primitive, p.kind, false};
    if (!crossings::has_bounds(p.kind)) return literal;
    // Solvers may be wrong by some last digits of the primitive's size or its distance.
    const double size = max_abs(p.bounds.hi - p.bounds.lo);
    const Aabb box = p.bounds.grown(model_.delta + (std::isfinite(size) ? 1e-6 * size : 0));
    Vec3 lo, hi;
    for (int a = 0; a < 3; ++a) {
      lo[a] = float_below(box.lo[a]);
      hi[a] = float_above(box.hi[a]);
    }
    literal.v = csg::box_slots(lo, hi);
    return literal;
  }

  /// Cuts the extent of the items' centres into `bins` equal slices along each axis.
  struct Slices {
    Slices(const Aabb& centers, std::size_t bins)
        : lo(centers.lo), last(static_cast<double>(bins - 1)) {
      for (int a = 0; a < 3; ++a) {
        const double extent = centers.hi[a] - centers.lo[a];
        scale[a] = extent > 0 ? static_cast<double>(bins) / extent : 0;
      }
    }
    std::size_t of(const Vec3& center, int axis) const {
      const double at = (center[axis] - lo[axis]) * scale[axis];
      // Written so that NaN, which centres beyond all doubles would give, stays within the slices.
      return at > 0 ? static_cast<std::size_t>(std::min(at, last)) : std::size_t{0};
    }
    Vec3 lo, scale;
    double last;
  };

  const Aabb& box(std::uint32_t item) const { return boxes_[item]; }
  static std::uint32_t add_item(Run items) { return items.front(); }

  /// Sorts the items into two parts by the best of up to kMaxBins planes a side through their
  /// centres.
  std::size_t split(Run items) const {
    if (items.size() == 2) return 1;
    Aabb centers = Aabb::nothing();
    for (const std::uint32_t i : items) centers.include(boxes_[i].center());
    const std::size_t bin_count = bins_for(items.size());
    const Slices slices(centers, bin_count);
    std::array<std::array<Bin<Aabb>, kMaxBins>, 3> bins;
    for (const std::uint32_t i : items) {
      const Vec3 center = boxes_[i].center();
      for (int axis = 0; axis < 3; ++axis) {
        bins[static_cast<std::size_t>(axis)][slices.of(center, axis)].add(boxes_[i], 1);
      }
    }
    Cut<Aabb> best;
    int best_axis = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(slices.scale[axis] > 0)) continue;
      const std::span row(bins[static_cast<std::size_t>(axis)]);
      const auto cut = cheapest_cut<Aabb>(row.first(bin_count), items.size());
      if (!(cut.cost < best.cost)) continue;
      best = cut;
      best_axis = axis;
    }
    if (best_axis < 0) return items.size() / 2;  // all centres coincide
    const auto middle = std::partition(items.begin(), items.end(), [&](std::uint32_t i) {
      return slices.of(boxes_[i].center(), best_axis) <= best.bin;
    });
    return static_cast<std::size_t>(middle - items.begin());
  }

  /// Puts items that are near each other in space, and their literals, near each other in memory.
  void put_items_in_tree_order() {
    std::vector<SurfaceItem> items;
    std::vector<Literal> literals;
    items.reserve(tree_.items_.size());
    literals.reserve(tree_.literals_.size());
    const auto move = [&](std::uint32_t index) {
      SurfaceItem item = tree_.items_[index];
      const auto own = tree_.literals_of(item);
      item.first_literal = static_cast<std::uint32_t>(literals.size());
      literals.insert(literals.end(), own.begin(), own.end());
      items.push_back(item);
      return static_cast<std::uint32_t>(items.size() - 1);
    };
    for (WideNode& node : tree_.nodes_) {
      for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
        if (node.is_item(i)) node.child[i] = WideNode::kItemFlag | move(node.item(i));
      }
    }
    for (std::uint32_t& index : tree_.unbounded_) index = move(index);
    tree_.items_ = std::move(items);
    tree_.literals_ = std::move(literals);
  }

  const Model& model_;
  SurfaceTreeOptions options_;
  SurfaceTree tree_;
  std::vector<Aabb> boxes_;
};

SurfaceTree SurfaceTree::build(const Model& model, const SurfaceTreeOptions& options) {
  return SurfaceTreeBuilder(model, options).run();
}

std::size_t SurfaceTree::memory_bytes() const {
  return nodes_.capacity() * sizeof(WideNode) + items_.capacity() * sizeof(SurfaceItem) +
         literals_.capacity() * sizeof(Literal) + program_nodes_.capacity() * sizeof(TreeNode) +
         operations_.capacity() * sizeof(crossings::MaskOperation) +
         cells_.capacity() * sizeof(Aabb);
}

}  // namespace graycube
