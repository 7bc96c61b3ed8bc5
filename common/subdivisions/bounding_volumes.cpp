#include "subdivisions/bounding_volumes.hpp"

#include "csg/tree.hpp"

namespace graycube {
namespace {

bool is_bounded(const BoundingVolumes& v) {
  return v.box != Aabb::everything() || std::isfinite(v.sphere.radius);
}

/// A sphere around two spheres.
BoundingSphere sphere_around(const BoundingSphere& a, const BoundingSphere& b) {
  const Vec3 way = b.center - a.center;
  const double distance = length(way);
  if (!(distance + b.radius > a.radius)) return a;
  if (!(distance + a.radius > b.radius)) return b;
  const double radius = 0.5 * (distance + a.radius + b.radius);
  return {a.center + ((radius - a.radius) / distance) * way, radius};
}

const BoundingSphere& smaller(const BoundingSphere& a, const BoundingSphere& b) {
  return b.radius < a.radius ? b : a;
}

BoundingSphere sphere_around(const Aabb& box) {
  if (box.is_empty()) return {{}, 0};
  if (!box.is_finite()) return {{}, kInf};
  return {box.center(), 0.5 * length(box.hi - box.lo)};
}

class Builder {
 public:
  explicit Builder(const Model& model) : model_(model), volumes_(model.nodes.size()) {}

  void add(std::size_t index) {
    const TreeNode& node = model_.nodes[index];
    const bool is_and = node.kind == TreeNode::Kind::kAnd;
    if (node.size == 1) {
      volumes_[index] = of_leaf(node);
      return;
    }
    for (std::size_t i = index + 1; i < index + node.size; i += model_.nodes[i].size) add(i);
    volumes_[index] = of_children(index, is_and);
  }

  std::vector<BoundingVolumes> take() { return std::move(volumes_); }

 private:
  BoundingVolumes of_leaf(const TreeNode& node) const {
    const Primitive& p = model_.primitives[node.primitive];
    BoundingVolumes v;
    v.box = p.bounds.grown(model_.delta);
    if (const auto sphere = bounding_sphere(p)) {
      v.sphere = {sphere->center, sphere->radius + 2 * model_.delta};
    }
    v.is_inside_beyond = node.kind == TreeNode::Kind::kInvertedLeaf;
    return v;
  }

  /// A conjunction is where all its children are, so that it lies in the volumes of each child
  /// that is bounded. Where all children are complements, so is it: of the union of what they are
  /// complements of. A disjunction is the same with inside and outside exchanged.
  BoundingVolumes of_children(std::size_t index, bool is_and) const {
    const std::size_t end = index + model_.nodes[index].size;
    BoundingVolumes within, around;
    around.box = Aabb::nothing();
    bool is_first = true, any_bounds = false;
    for (std::size_t i = index + 1; i < end; i += model_.nodes[i].size) {
      const BoundingVolumes& child = volumes_[i];
      if (child.is_inside_beyond != is_and && is_bounded(child)) {
        within.box = any_bounds ? intersection_of(within.box, child.box) : child.box;
        within.sphere = smaller(within.sphere, child.sphere);
        any_bounds = true;
      }
      around.box = union_of(around.box, child.box);
      around.sphere = is_first ? child.sphere : sphere_around(around.sphere, child.sphere);
      is_first = false;
    }
    BoundingVolumes& result = any_bounds ? within : around;
    if (result.box.is_empty()) result.box = Aabb::nothing();
    result.sphere = smaller(result.sphere, sphere_around(result.box));
    result.is_inside_beyond = any_bounds ? !is_and : is_and;
    return result;
  }

  const Model& model_;
  std::vector<BoundingVolumes> volumes_;
};

}  // namespace

std::vector<BoundingVolumes> bounding_volumes_of(const Model& model) {
  Builder builder(model);
  for (const Object& object : model.objects) builder.add(object.first_node);
  return builder.take();
}

}  // namespace graycube
