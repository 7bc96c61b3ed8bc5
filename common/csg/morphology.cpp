#include "csg/morphology.hpp"

#include <algorithm>
#include <span>

#include "csg/kinds.hpp"
#include "csg/tree.hpp"

namespace graycube {
namespace {

using Kind = PrimitiveKind;

Primitive box_around(const Primitive& p, double by) {
  Primitive box;
  box.kind = Kind::kBox;
  box.material = p.material;
  box.bounds = p.bounds.grown(by);
  box.v = csg::box_slots(box.bounds.lo, box.bounds.hi);
  return box;
}

/// A moved copy of a primitive; nothing when its kind can't be moved, or nothing is left of it.
std::optional<Primitive> moved(Primitive p, const PrimitiveData& data, double by,
                               std::vector<Plane>& planes) {
  const auto& kind = csg::traits_of(p.kind);
  if (kind.move == nullptr || !kind.move(p, data, by, planes)) return std::nullopt;
  return p;
}

Aabb dilated_bounds(const Primitive& p, double by) {
  const auto& kind = csg::traits_of(p.kind);
  return kind.grown_bounds != nullptr ? kind.grown_bounds(p, by) : p.bounds.grown(by);
}

/// Makes a dilated or eroded scene from another, leaf by leaf.
class Resizing {
 public:
  Resizing(const Model& model, const ObjectDistance& by, bool grows)
      : model_(model), by_(by), grows_(grows) {
    out_.settings = model.settings;
    out_.delta = model.delta;
    out_.materials = model.materials;
  }

  std::optional<Model> run() && {
    for (const Object& object : model_.objects) {
      if (!grows_ && !is_opaque(object)) continue;
      if (add(object) == Pruned::kEverything) return std::nullopt;
    }
    return std::move(out_);
  }

 private:
  std::span<const TreeNode> tree_of(const Object& object) const {
    return {model_.nodes.data() + object.first_node, object.node_count};
  }
  static bool is_leaf(const TreeNode& node) {
    return node.kind == TreeNode::Kind::kLeaf || node.kind == TreeNode::Kind::kInvertedLeaf;
  }
  bool is_opaque(const Object& object) const {
    const auto tree = tree_of(object);
    return std::all_of(tree.begin(), tree.end(), [&](const TreeNode& node) {
      return !is_leaf(node) ||
             !(model_.materials[model_.primitives[node.primitive].material].transmit > 0);
    });
  }

  Pruned add(const Object& object) {
    tree_.assign(tree_of(object).begin(), tree_of(object).end());
    const std::size_t first_primitive = out_.primitives.size();
    is_gone_.clear();
    const double by = by_(object);
    for (TreeNode& node : tree_) {
      if (is_leaf(node)) resize(node, by);
    }
    const auto side_of = [&](std::uint32_t primitive) {
      return is_gone_[primitive - first_primitive] ? CellSide::kOutside : CellSide::kCrosses;
    };
    Object left = object;
    left.first_node = static_cast<std::uint32_t>(out_.nodes.size());
    const Pruned result = prune(std::span<const TreeNode>(tree_), side_of, out_.nodes);
    if (result != Pruned::kVaries) {
      out_.primitives.resize(first_primitive);
      return result;
    }
    left.node_count = static_cast<std::uint32_t>(out_.nodes.size() - left.first_node);
    left.bounds =
        bounds_of(std::span<const TreeNode>(out_.nodes).subspan(left.first_node), out_.primitives);
    out_.objects.push_back(left);
    return result;
  }

  void resize(TreeNode& leaf, double by) {
    const Primitive& p = model_.primitives[leaf.primitive];
    const bool grows = grows_ == (leaf.kind == TreeNode::Kind::kLeaf);
    const auto resized = grows ? dilated(p, model_.data(), by, out_.planes)
                               : eroded(p, model_.data(), by, out_.planes);
    leaf.primitive = static_cast<std::uint32_t>(out_.primitives.size());
    is_gone_.push_back(!resized);
    out_.primitives.push_back(resized.value_or(p));
  }

  const Model& model_;
  const ObjectDistance& by_;
  bool grows_;
  Model out_;
  std::vector<TreeNode> tree_;
  /// For each leaf of the current object's tree, whether nothing is left of it.
  std::vector<bool> is_gone_;
};

}  // namespace

Primitive dilated(const Primitive& p, const PrimitiveData& data, double by,
                  std::vector<Plane>& planes) {
  auto larger = moved(p, data, by, planes);
  if (!larger) return box_around(p, by);
  larger->bounds = dilated_bounds(p, by);
  if (larger->kind == Kind::kPolyhedron)
    larger->bounds = csg::polyhedron_bounds(csg::faces_of(*larger, planes));
  return *larger;
}

std::optional<Primitive> eroded(const Primitive& p, const PrimitiveData& data, double by,
                                std::vector<Plane>& planes) {
  return moved(p, data, -by, planes);
}

std::optional<Model> dilated(const Model& model, const ObjectDistance& by) {
  return Resizing(model, by, true).run();
}
// An eroded solid never fills all of space, so there always is a result.
Model eroded(const Model& model, const ObjectDistance& by) {
  return *Resizing(model, by, false).run();
}

}  // namespace graycube
