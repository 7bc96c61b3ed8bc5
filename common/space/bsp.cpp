#include "space/bsp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// A plane and its cost by the surface-area heuristic.
struct Split {
  int axis = -1;
  double at = 0;
  double cost = std::numeric_limits<double>::infinity();
};

/// Chooses a plane for a cell: the extents of the surfaces in it, and sweeps over their ends.
class SplitFinder {
 public:
  SplitFinder(const Aabb& cell, double gap, double step_cost)
      : cell_(cell), gap_(gap), step_cost_(step_cost) {}

  void add(const Aabb& surface) {
    const Aabb b = intersection_of(surface, cell_);
    if (b.is_empty()) return;
    for (int a = 0; a < 3; ++a) {
      lower_[static_cast<std::size_t>(a)].push_back(b.lo[a]);
      upper_[static_cast<std::size_t>(a)].push_back(b.hi[a]);
    }
  }
  std::size_t count() const { return lower_[0].size(); }

  Split best() {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (count() <= kExactLimit) {
        sweep_exact(axis, best);
      } else {
        sweep_bins(axis, best);
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t kExactLimit = 256;
  static constexpr int kBins = 64;

  /// Cost of the plane with so many surfaces below and above.
  void offer(int axis, double at, std::size_t below, std::size_t above, Split& best) const {
    if (!(at > cell_.lo[axis] + gap_ && at < cell_.hi[axis] - gap_)) return;
    Aabb lower = cell_;
    lower.hi[axis] = at;
    Aabb upper = cell_;
    upper.lo[axis] = at;
    const double area = cell_.half_area();
    double cost = (lower.half_area() * static_cast<double>(below) +
                   upper.half_area() * static_cast<double>(above)) / area;
    // A cell without surfaces costs nothing but the step into it.
    if (below == 0 || above == 0) cost *= kEmptyDiscount;
    cost += step_cost_;
    if (cost < best.cost) best = {axis, at, cost};
  }
  static constexpr double kEmptyDiscount = 0.8;

  void sweep_exact(int axis, Split& best) {
    auto& lo = lower_[static_cast<std::size_t>(axis)];
    auto& hi = upper_[static_cast<std::size_t>(axis)];
    std::sort(lo.begin(), lo.end());
    std::sort(hi.begin(), hi.end());
    const std::size_t n = lo.size();
    // Planes just below a lower end and just above an upper end, so that neither touches the other side.
    std::size_t ended = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = lo[i] - 2 * gap_;
      while (ended < n && hi[ended] < at) ++ended;
      offer(axis, at, i, n - ended, best);
    }
    std::size_t begun = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = hi[i] + 2 * gap_;
      while (begun < n && lo[begun] <= at) ++begun;
      offer(axis, at, begun, n - i - 1, best);
    }
  }

  void sweep_bins(int axis, Split& best) {
    const auto& lo = lower_[static_cast<std::size_t>(axis)];
    const auto& hi = upper_[static_cast<std::size_t>(axis)];
    const double first = *std::min_element(lo.begin(), lo.end());
    const double last = *std::max_element(hi.begin(), hi.end());
    offer(axis, first - 2 * gap_, 0, lo.size(), best);
    offer(axis, last + 2 * gap_, lo.size(), 0, best);
    if (!(last - first > 4 * gap_)) return;
    const double scale = kBins / (last - first);
    std::array<std::size_t, kBins + 1> begins{}, ends{};
    const auto bin = [&](double v) {
      return static_cast<std::size_t>(std::clamp((v - first) * scale, 0.0, kBins - 1.0));
    };
    for (const double v : lo) ++begins[bin(v)];
    for (const double v : hi) ++ends[bin(v)];
    std::size_t begun = 0;
    std::size_t ended = 0;
    for (int i = 1; i < kBins; ++i) {
      begun += begins[static_cast<std::size_t>(i - 1)];
      ended += ends[static_cast<std::size_t>(i - 1)];
      offer(axis, first + i / scale, begun, lo.size() - ended, best);
    }
  }

  Aabb cell_;
  double gap_, step_cost_;
  std::array<std::vector<double>, 3> lower_, upper_;
};

}  // namespace

class BspBuilder {
 public:
  BspBuilder(const Model& model, const BspOptions& options) : model_(model), options_(options) {
    bsp_.model_ = &model;
  }

  Bsp run() {
    CellContent content;
    for (std::uint32_t i = 0; i < model_.objects.size(); ++i) {
      const Object& object = model_.objects[i];
      restrict_tree({model_.nodes.data() + object.first_node, object.node_count}, i,
                    Aabb::everything(), content);
    }
    bsp_.nodes_.emplace_back();
    split_off_outside(finite_extent(), std::move(content));
    link({kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour, kNoNeighbour}, 0);
    return std::move(bsp_);
  }

 private:
  /// Bounds of the finite parts of all primitives, empty when there is none.
  Aabb finite_extent() const {
    Aabb extent = Aabb::nothing();
    for (const Primitive& p : model_.primitives) {
      if (p.bounds.is_finite()) extent = union_of(extent, p.bounds);
    }
    return extent;
  }

  void restrict_tree(std::span<const TreeNode> tree, std::uint32_t object, const Aabb& grown,
                     CellContent& out) const {
    const auto first = static_cast<std::uint32_t>(out.nodes.size());
    const auto side = [&](std::uint32_t primitive) {
      return classify(model_.primitives[primitive], model_.planes, grown);
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

  /// The unbounded space around the finite primitives is cut off by six planes; what lies outside holds
  /// only unbounded primitives and is not cut further.
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

  /// The boxes of the surfaces in a cell: each primitive's bounds within those of what it bounds.
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

  /// Hands every leaf region its neighbour links. `outer` are those of the cell of `node`; a link goes down
  /// as long as one child touches the whole face.
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
  return BspBuilder(model, options).run();
}

std::size_t Bsp::memory_bytes() const {
  return nodes_.capacity() * sizeof(BspNode) + leaves_.capacity() * sizeof(BspLeaf) +
         programs_.capacity() * sizeof(CellProgram) + program_nodes_.capacity() * sizeof(TreeNode);
}

}  // namespace graycube
