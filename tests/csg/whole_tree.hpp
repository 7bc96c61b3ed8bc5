// The reference: an object's whole tree evaluated along a whole ray, with nothing clever about it.
// Written from the scene file's definition, over a recursive tree of its own: all ends of all
// primitives' intervals are sorted; at each distinct parameter membership just before and just
// after is looked up; where it differs the surface is crossed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "csg/model.hpp"
#include "scene/scene.hpp"

namespace graycube::testing {

struct SolidTree {
  enum class Kind : std::uint8_t { kUnion, kIntersection, kDifference, kComplement, kLeaf };
  Kind kind = Kind::kLeaf;
  std::vector<SolidTree> children;
  /// For leaves: the index into Model::primitives.
  std::uint32_t primitive = 0;
};

/// Membership of the whole tree, given each leaf's.
template <typename IsInside>
bool holds(const SolidTree& tree, const IsInside& is_inside) {
  const auto child = [&](const SolidTree& c) { return holds(c, is_inside); };
  const auto first = tree.children.begin(), last = tree.children.end();
  switch (tree.kind) {
    case SolidTree::Kind::kUnion: return std::any_of(first, last, child);
    case SolidTree::Kind::kIntersection: return std::all_of(first, last, child);
    case SolidTree::Kind::kDifference: return child(*first) && std::none_of(first + 1, last, child);
    case SolidTree::Kind::kComplement: return !child(*first);
    case SolidTree::Kind::kLeaf: return is_inside(tree.primitive);
  }
  return false;
}

/// The tree of an object in the compiled model.
inline SolidTree solid_of(std::span<const TreeNode> nodes) {
  const TreeNode& root = nodes.front();
  SolidTree tree;
  tree.primitive = root.primitive;
  if (root.kind == TreeNode::Kind::kLeaf) return tree;
  if (root.kind == TreeNode::Kind::kInvertedLeaf) {
    return {SolidTree::Kind::kComplement, {tree}, 0};
  }
  tree.kind =
      root.kind == TreeNode::Kind::kAnd ? SolidTree::Kind::kIntersection : SolidTree::Kind::kUnion;
  for (std::size_t i = 1; i < root.size; i += nodes[i].size) {
    tree.children.push_back(solid_of(nodes.subspan(i, nodes[i].size)));
  }
  return tree;
}
inline SolidTree solid_of(const Model& model, const Object& object) {
  return solid_of(std::span(model.nodes).subspan(object.first_node, object.node_count));
}

inline SolidTree solid_of(const Scene& scene, const CsgNode& node, std::uint32_t& next);
/// A repeat's copies under products of up to `depth` maps.
inline SolidTree copies_of(const Scene& scene, const RepeatNode& repeat, std::uint32_t depth,
                           std::uint32_t& next) {
  SolidTree tree;
  tree.kind = SolidTree::Kind::kUnion;
  if (depth == 0 || repeat.kept == KeptCopies::kAll) {
    tree.children.push_back(solid_of(scene, repeat.child.front(), next));
  }
  for (std::size_t map = 0; depth > 0 && map < repeat.maps.size(); ++map) {
    tree.children.push_back(copies_of(scene, repeat, depth - 1, next));
  }
  return tree;
}
/// A tree as written in the scene. The compiled model numbers leaves in the order of the file,
/// references and repeats expanded; `next` is the number of the first.
inline SolidTree solid_of(const Scene& scene, const CsgNode& node, std::uint32_t& next) {
  if (const auto* ref = std::get_if<ReferenceNode>(&node.value)) {
    return solid_of(scene, scene.shapes[ref->shape].node, next);
  }
  if (const auto* repeat = std::get_if<RepeatNode>(&node.value)) {
    return copies_of(scene, *repeat, repeat->depth, next);
  }
  SolidTree tree;
  if (const auto* o = std::get_if<OperationNode>(&node.value)) {
    using Kind = SolidTree::Kind;
    tree.kind = o->operation == Operation::kUnion          ? Kind::kUnion
                : o->operation == Operation::kIntersection ? Kind::kIntersection
                : o->operation == Operation::kDifference   ? Kind::kDifference
                                                           : Kind::kComplement;
    for (const CsgNode& child : o->children) tree.children.push_back(solid_of(scene, child, next));
  } else {
    tree.primitive = next++;
  }
  return tree;
}

struct WholeCrossing {
  double t = 0;
  std::uint32_t primitive = 0, object = 0;
  bool entering = false;

  friend bool operator==(const WholeCrossing&, const WholeCrossing&) = default;
};

class WholeTrees {
 public:
  /// Evaluates the compiled trees.
  explicit WholeTrees(const Model& model) : model_(model) {
    for (const Object& o : model.objects) trees_.push_back(solid_of(model, o));
  }
  /// Evaluates the trees as written; the model gives only the primitives.
  WholeTrees(const Model& model, const Scene& scene) : model_(model) {
    std::uint32_t next = 0;
    for (const SceneObject& o : scene.objects) trees_.push_back(solid_of(scene, o.csg, next));
  }

  std::size_t object_count() const { return trees_.size(); }
  const SolidTree& tree(std::size_t object) const { return trees_[object]; }

  bool contains_point(std::size_t object, const Vec3& p) const {
    return holds(trees_[object],
                 [&](std::uint32_t i) { return contains(model_.primitives[i], model_.data(), p); });
  }

  /// Every crossing of one object on the whole line, in order of t.
  std::vector<WholeCrossing> crossings(std::uint32_t object, const Ray& ray) const {
    std::vector<Entry> entries;
    collect(trees_[object], ray, entries);
    std::vector<double> ends;
    for (const Entry& e : entries) {
      for (int i = 0; i < e.spans.count; ++i) {
        const auto& interval = e.spans.interval[static_cast<std::size_t>(i)];
        ends.push_back(interval.enter);
        ends.push_back(interval.leave);
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<WholeCrossing> found;
    for (const double t : ends) {
      const auto before = [&](std::uint32_t p) { return is_inside(entries, p, t, false); };
      const auto after = [&](std::uint32_t p) { return is_inside(entries, p, t, true); };
      const bool inside = holds(trees_[object], after);
      if (holds(trees_[object], before) == inside) continue;
      found.push_back({t, changed(trees_[object], before, after), object, inside});
    }
    return found;
  }

  /// Crossings of all objects with t0 ≤ t < t1, in order of t, then of the objects.
  std::vector<WholeCrossing> crossings_between(const Ray& ray, double t0, double t1) const {
    std::vector<WholeCrossing> all;
    for (std::uint32_t o = 0; o < trees_.size(); ++o) {
      for (const WholeCrossing& c : crossings(o, ray)) {
        if (c.t >= t0 && c.t < t1) all.push_back(c);
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t; });
    return all;
  }

 private:
  struct Entry {
    std::uint32_t primitive;
    Spans spans;
  };

  void collect(const SolidTree& tree, const Ray& ray, std::vector<Entry>& entries) const {
    if (tree.kind == SolidTree::Kind::kLeaf) {
      entries.push_back(
          {tree.primitive, spans_along(model_.primitives[tree.primitive], model_.data(), ray)});
    }
    for (const SolidTree& c : tree.children) collect(c, ray, entries);
  }

  /// Membership just after (or before) t; intervals are closed: of length zero, they hold neither.
  static bool is_inside(const std::vector<Entry>& entries, std::uint32_t primitive, double t,
                        bool just_after) {
    const auto e = std::find_if(entries.begin(), entries.end(),
                                [&](const Entry& x) { return x.primitive == primitive; });
    for (int i = 0; i < e->spans.count; ++i) {
      const auto& [enter, leave] = e->spans.interval[static_cast<std::size_t>(i)];
      if (just_after ? enter <= t && leave > t : enter < t && leave >= t) return true;
    }
    return false;
  }

  /// Descends into the first child whose own membership changed.
  template <typename Before, typename After>
  static std::uint32_t changed(const SolidTree& tree, const Before& before, const After& after) {
    for (const SolidTree& c : tree.children) {
      if (holds(c, before) != holds(c, after)) return changed(c, before, after);
    }
    return tree.primitive;
  }

  const Model& model_;
  std::vector<SolidTree> trees_;
};

}  // namespace graycube::testing
