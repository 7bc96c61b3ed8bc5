#include "crossings/surface_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "crossings/bsp.hpp"
#include "csg/tree.hpp"
#include "geometry/culling_ray.hpp"

namespace graycube {
namespace {

constexpr float kFloatInf = std::numeric_limits<float>::infinity();

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
      tree_.nodes_.emplace_back();
      build_node(0, bounded, 0);
      put_items_in_tree_order();
    }
    return std::move(tree_);
  }

 private:
  static constexpr std::size_t kBins = 16;
  /// A few items need no more slices than there are items, by far the most groups are such.
  static std::size_t bins_for(std::size_t items) {
    return std::clamp<std::size_t>(items, 2, kBins);
  }
  /// From here on groups are simply halved, so that no heap of items, however skewed, makes the
  /// tree deeper than the walk's stack: 32 more levels, each of which halves the largest group at
  /// least, end 2³² items.
  static constexpr std::size_t kMaxChosenDepth = 40;
  static_assert(kMaxChosenDepth + 32 <= SurfaceTree::kMaxDepth);

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
      item.is_small = item.is_small && p.kind != PrimitiveKind::kMesh;
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
    for (std::size_t a = 0; a < 3; ++a) {
      literal.v[a] = float_below(box.lo[static_cast<int>(a)]);
      literal.v[a + 3] = float_above(box.hi[static_cast<int>(a)]);
    }
    return literal;
  }

  struct Group {
    std::span<std::uint32_t> items;
    Aabb box = Aabb::nothing();
  };

  Group group_of(std::span<std::uint32_t> items) const {
    Group g{items, Aabb::nothing()};
    for (const std::uint32_t i : items) g.box = union_of(g.box, boxes_[i]);
    return g;
  }

  /// One of `bins` slices of the centres' extent along each axis.
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

  /// Sorts the items into two halves by the best of up to kBins planes a side through their
  /// centres.
  std::size_t partition(std::span<std::uint32_t> items) const {
    if (items.size() == 2) return 1;
    Aabb centers = Aabb::nothing();
    for (const std::uint32_t i : items) centers.include(boxes_[i].center());
    const std::size_t bin_count = bins_for(items.size());
    const Slices slices(centers, bin_count);
    struct Bin {
      Aabb box = Aabb::nothing();
      std::size_t count = 0;
    };
    std::array<std::array<Bin, kBins>, 3> bins;
    for (const std::uint32_t i : items) {
      const Vec3 center = boxes_[i].center();
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[static_cast<std::size_t>(axis)][slices.of(center, axis)];
        bin.box = union_of(bin.box, boxes_[i]);
        ++bin.count;
      }
    }
    double best_cost = Aabb::kInf;
    int best_axis = -1;
    std::size_t best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(slices.scale[axis] > 0)) continue;
      const auto& row = bins[static_cast<std::size_t>(axis)];
      std::array<double, kBins> above_cost{};
      Bin above;
      for (std::size_t b = bin_count - 1; b > 0; --b) {
        above.box = union_of(above.box, row[b].box);
        above.count += row[b].count;
        above_cost[b] =
            above.count == 0 ? 0 : above.box.half_area() * static_cast<double>(above.count);
      }
      Bin below;
      for (std::size_t b = 0; b + 1 < bin_count; ++b) {
        below.box = union_of(below.box, row[b].box);
        below.count += row[b].count;
        if (below.count == 0 || below.count == items.size()) continue;
        const double cost =
            below.box.half_area() * static_cast<double>(below.count) + above_cost[b + 1];
        if (cost < best_cost) {
          best_cost = cost;
          best_axis = axis;
          best_bin = b;
        }
      }
    }
    if (best_axis < 0) return items.size() / 2;  // all centres coincide
    const auto middle = std::partition(items.begin(), items.end(), [&](std::uint32_t i) {
      return slices.of(boxes_[i].center(), best_axis) <= best_bin;
    });
    return static_cast<std::size_t>(middle - items.begin());
  }

  void build_node(std::uint32_t index, std::span<std::uint32_t> items, std::size_t depth) {
    std::vector<Group> groups{group_of(items)};
    while (groups.size() < WideNode::kWidth) {
      // The group with the largest surface is opened next.
      std::size_t widest = groups.size();
      for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].items.size() < 2) continue;
        if (widest == groups.size() || groups[g].box.half_area() > groups[widest].box.half_area()) {
          widest = g;
        }
      }
      if (widest == groups.size()) break;
      const auto all = groups[widest].items;
      const std::size_t middle = depth < kMaxChosenDepth ? partition(all) : all.size() / 2;
      groups[widest] = group_of(all.first(middle));
      groups.push_back(group_of(all.subspan(middle)));
    }
    WideNode node;
    for (std::size_t g = 0; g < WideNode::kWidth; ++g) {
      const bool used = g < groups.size();
      for (std::size_t a = 0; a < 3; ++a) {
        node.planes[0][a][g] =
            used ? float_below(groups[g].box.lo[static_cast<int>(a)]) : kFloatInf;
        node.planes[1][a][g] =
            used ? float_above(groups[g].box.hi[static_cast<int>(a)]) : -kFloatInf;
      }
      if (!used) continue;
      if (groups[g].items.size() == 1) {
        node.child[g] = WideNode::kItemFlag | groups[g].items.front();
      } else {
        node.child[g] = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
      }
    }
    tree_.nodes_[index] = node;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].items.size() > 1) build_node(node.child[g], groups[g].items, depth + 1);
    }
  }

  /// Items that are near each other in space become so in memory, with their literals.
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
      for (std::uint32_t& child : node.child) {
        if ((child & WideNode::kItemFlag) == 0) continue;
        child = WideNode::kItemFlag | move(child & ~WideNode::kItemFlag);
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
