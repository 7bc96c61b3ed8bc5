#include "visibility/foreign_bounds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "geometry/float_box.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

/// The typical number of items among a node's branches.
constexpr std::size_t kBoxesPerNode = 5;

/// A box with its child or item, for one place of a node.
struct Branch {
  FloatBox box;
  std::uint32_t child;
};

/// The branches of a node.
struct Branches {
  std::size_t count = 0;
  // Not initialized, since there are many.
  std::array<Branch, WideNode::kWidth> list;

  void add(const Branch& b) { list[count++] = b; }
  FloatBox box() const {
    FloatBox all = FloatBox::nothing();
    for (std::size_t i = 0; i < count; ++i) all.include(list[i].box);
    return all;
  }
};

/// Bounds of the objects held in part of which the whole tree has no item, as they are empty: their
/// parts may show surfaces all the same, beyond the region for which they are right.
Aabb bounds_of_empty_parts(const SurfaceTree& tree, const ModelContents& contents) {
  std::vector<bool> has_items(tree.model().objects.size());
  for (const SurfaceItem& item : tree.items()) has_items[item.object] = true;
  Aabb all = Aabb::nothing();
  for (const ModelContents::Part& part : contents.parts) {
    const Aabb& box = tree.model().objects[part.object].bounds;
    if (has_items[part.object] || box.is_empty()) continue;
    all.include(box.lo);
    all.include(box.hi);
  }
  return all;
}

/// Copies a tree without the objects that are held, from the leaves up.
class Pruning {
 public:
  /// `items` holds the number of items below each node. Up to `most_together` share one box.
  /// `empty_parts` are foreign beside what is in the tree.
  Pruning(const SurfaceTree& tree, std::span<const std::uint32_t> items,
          const ModelContents& contents, const Aabb& empty_parts, std::size_t most_together)
      : tree_(tree),
        items_(items),
        contents_(contents),
        empty_parts_(empty_parts),
        most_together_(most_together),
        is_part_(tree.model().objects.size()) {
    for (const ModelContents::Part& part : contents.parts) is_part_[part.object] = true;
  }

  std::vector<WideNode> run() {
    Branches root;
    if (!tree_.nodes().empty()) root = branches_of(tree_.nodes().front());
    if (!empty_parts_.is_empty()) add_empty_parts(root);
    if (root.count > 0) add_node(root);
    // Children were made first, so the order of all nodes is reversed.
    std::reverse(nodes_.begin(), nodes_.end());
    for (WideNode& node : nodes_) {
      for (std::uint32_t& child : node.child) {
        if ((child & WideNode::kItemFlag) == 0)
          child = static_cast<std::uint32_t>(nodes_.size()) - 1 - child;
      }
    }
    return std::move(nodes_);
  }

 private:
  /// A root without room becomes one box around everything.
  void add_empty_parts(Branches& root) {
    Branch all{float_box_around(empty_parts_.grown(tree_.model().delta)), WideNode::kItemFlag};
    if (root.count == WideNode::kWidth) {
      all.box.include(root.box());
      root.count = 0;
      nodes_.clear();
    }
    root.add(all);
  }

  Branches branches_of(const WideNode& node) {
    std::array<Branches, WideNode::kWidth> below;
    std::size_t count = 0;
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      if (!node.is_used(i)) continue;
      Branches& b = below[count];
      b.count = 0;
      if (node.is_item(i)) {
        if (is_foreign(node, i)) b.add(item_branch(node, i));
      } else if (items_[node.child[i]] > most_together_) {
        b = branches_of(tree_.nodes()[node.child[i]]);
      } else if (auto together = all_together(node, i)) {
        b.add(*together);
      }
      if (b.count > 0) ++count;
    }
    // A child with few branches needs no node of its own, as long as this node has room for its
    // branches and for all other children.
    Branches all;
    std::size_t others = count;
    for (std::size_t size = 1; size <= WideNode::kWidth; ++size) {
      for (std::size_t i = 0; i < count; ++i) {
        if (below[i].count != size) continue;
        --others;
        if (all.count + size + others <= WideNode::kWidth) {
          for (std::size_t k = 0; k < size; ++k) all.add(below[i].list[k]);
        } else {
          all.add(add_node(below[i]));
        }
      }
    }
    return all;
  }

  std::uint32_t object_of(const WideNode& node, std::size_t place) const {
    return tree_.items()[node.item(place)].object;
  }
  bool is_foreign(const WideNode& node, std::size_t place) const {
    return !contents_.is_whole[object_of(node, place)];
  }

  Branch item_branch(const WideNode& node, std::size_t place) const {
    const std::uint32_t object = object_of(node, place);
    if (!is_part_[object]) return place_branch(node, place);
    return {float_box_around(tree_.model().objects[object].bounds.grown(tree_.model().delta)),
            WideNode::kItemFlag};
  }

  static Branch place_branch(const WideNode& node, std::size_t place) {
    return {node.box(place), WideNode::kItemFlag};
  }

  /// One box, maybe too large, around all that is foreign below a place; nothing if nothing is.
  std::optional<Branch> all_together(const WideNode& parent, std::size_t place) const {
    Branch all = place_branch(parent, place);
    return add_foreign_below(tree_.nodes()[parent.child[place]], all.box) ? std::optional(all)
                                                                          : std::nullopt;
  }
  /// Whether something below a node is foreign; `box` grows to enclose all objects held in part.
  bool add_foreign_below(const WideNode& node, FloatBox& box) const {
    bool any = false;
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      if (!node.is_used(i)) continue;
      if (!node.is_item(i)) {
        any = add_foreign_below(tree_.nodes()[node.child[i]], box) || any;
      } else if (is_foreign(node, i)) {
        any = true;
        if (is_part_[object_of(node, i)]) box.include(item_branch(node, i).box);
      }
      // The items that are left can't change the box.
      if (any && contents_.parts.empty()) return true;
    }
    return any;
  }

  Branch add_node(const Branches& branches) {
    WideNode& node = nodes_.emplace_back();
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      const bool is_used = i < branches.count;
      node.set_box(i, is_used ? branches.list[i].box : FloatBox::nothing());
      node.child[i] = is_used ? branches.list[i].child : WideNode::kItemFlag;
    }
    return {branches.box(), static_cast<std::uint32_t>(nodes_.size() - 1)};
  }

  const SurfaceTree& tree_;
  std::span<const std::uint32_t> items_;
  const ModelContents& contents_;
  const Aabb& empty_parts_;
  std::size_t most_together_;
  std::vector<bool> is_part_;
  std::vector<WideNode> nodes_;
};

}  // namespace

ForeignBoundsMaker::ForeignBoundsMaker(const SurfaceTree& whole)
    : tree_(whole), items_(whole.nodes().size()) {
  // Children come behind their parents.
  for (std::size_t n = items_.size(); n-- > 0;) {
    const WideNode& node = whole.nodes()[n];
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      if (!node.is_used(i)) continue;
      items_[n] += node.is_item(i) ? 1 : items_[node.child[i]];
    }
  }
}

std::optional<ForeignBounds> ForeignBoundsMaker::bounds(const ModelContents& contents,
                                                        std::size_t most_bytes) const {
  for (const std::uint32_t item : tree_.unbounded_items()) {
    if (!contents.is_whole[tree_.items()[item].object]) return std::nullopt;
  }
  const Aabb empty_parts = bounds_of_empty_parts(tree_, contents);
  if (!empty_parts.is_empty() && !empty_parts.is_finite()) return std::nullopt;
  const std::size_t most_nodes = std::max<std::size_t>(1, most_bytes / sizeof(WideNode));
  const auto foreign = static_cast<std::size_t>(
      std::count_if(tree_.items().begin(), tree_.items().end(),
                    [&](const SurfaceItem& i) { return !contents.is_whole[i.object]; }));
  for (std::size_t together = std::bit_ceil(foreign / (kBoxesPerNode * most_nodes) + 1);;
       together *= 2) {
    stop_if_asked();
    std::vector<WideNode> nodes = Pruning(tree_, items_, contents, empty_parts, together).run();
    if (nodes.size() <= most_nodes) return ForeignBounds(std::move(nodes));
  }
}

}  // namespace graycube
