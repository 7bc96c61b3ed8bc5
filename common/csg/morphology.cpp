#include "csg/morphology.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "csg/cylinder.hpp"
#include "csg/half_space.hpp"
#include "csg/tree.hpp"

namespace graycube {
namespace {

using Kind = PrimitiveKind;

/// How far a local point can move along each of the first `rows` local axes together when the
/// world's moves by 1: at least the norm of these rows of the map (by Gershgorin's circles).
double stretch(const Affine& to_local, int rows) {
  double most = 0;
  for (int i = 0; i < rows; ++i) {
    double sum = 0;
    for (int j = 0; j < rows; ++j) sum += std::fabs(dot(to_local.row(i), to_local.row(j)));
    most = std::max(most, sum);
  }
  return std::sqrt(most);
}

void divide_row(Affine& map, int row, double by) {
  for (double& x : map.m[static_cast<std::size_t>(row)]) x /= by;
}

/// The bounds of a solid that grows by `local` along each of its own axes.
Aabb grown_bounds(const Primitive& p, const Vec3& local) {
  const auto to_world = p.to_local.inverse();
  if (!to_world) return Aabb::everything();
  Vec3 by;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = to_world->row(i);
    by[i] = std::fabs(r.x) * local.x + std::fabs(r.y) * local.y + std::fabs(r.z) * local.z;
  }
  return {p.bounds.lo - by, p.bounds.hi + by};
}

Primitive box_around(const Primitive& p, double by) {
  Primitive box;
  box.kind = Kind::kBox;
  box.material = p.material;
  box.bounds = p.bounds.grown(by);
  const Aabb& b = box.bounds;
  box.v = {b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z};
  return box;
}

/// Moves the surface outwards by `by`, inwards where it is negative; bounds stay. Nothing when no
/// such solid is known, or it is empty.
std::optional<Primitive> moved(Primitive p, const PrimitiveData& data, double by,
                               std::vector<Plane>& planes) {
  const auto move_caps = [&] {
    p.v[3] -= by;
    p.v[4] += by;
    return p.v[3] < p.v[4];
  };
  switch (p.kind) {
    case Kind::kSphere:
      p.v[3] += by;
      if (!(p.v[3] > 0)) return std::nullopt;
      return p;
    case Kind::kEllipsoid: {
      const double radius = 1 + by * stretch(p.to_local, 3);
      if (!(radius > 0)) return std::nullopt;
      for (int i = 0; i < 3; ++i) divide_row(p.to_local, i, radius);
      return p;
    }
    case Kind::kBox:
    case Kind::kParallelepiped:
      for (std::size_t a = 0; a < 3; ++a) {
        p.v[a] -= by;
        p.v[a + 3] += by;
        if (!(p.v[a] < p.v[a + 3])) return std::nullopt;
      }
      return p;
    case Kind::kCylinder: {
      const double radius = 1 + by * stretch(p.to_local, 2);
      if (!(radius > 0) || !move_caps()) return std::nullopt;
      for (int i = 0; i < 2; ++i) divide_row(p.to_local, i, radius);
      return p;
    }
    case Kind::kCone: {
      // The radius at height z is (1 + k z): it grows by what a point moves across, and by what it
      // moves along.
      const double k = p.v[5];
      const double radius =
          1 + by * (stretch(p.to_local, 2) + std::fabs(k) * length(p.to_local.row(2)));
      if (!(radius > 0) || !move_caps()) return std::nullopt;
      for (int i = 0; i < 2; ++i) divide_row(p.to_local, i, radius);
      p.v[5] = k / radius;
      // The caps of a smaller cone may reach beyond its apex, where the other nappe begins.
      const auto to_world = p.to_local.inverse();
      if (!to_world) return std::nullopt;
      const Vec3 apex = to_world->point({0, 0, -1 / p.v[5]});
      p.v[4] = std::min(p.v[4], dot(csg::cap_normal(p), apex));
      if (!(p.v[3] < p.v[4])) return std::nullopt;
      return p;
    }
    case Kind::kTorus:
      p.v[0] += by * stretch(p.to_local, 3);
      if (!(p.v[0] > 0) || !(p.v[0] < 1)) return std::nullopt;
      return p;
    case Kind::kHalfSpace: p.v[3] += by; return p;
    case Kind::kPolyhedron: {
      const auto faces = csg::faces_of(p, data.planes);
      p.first_plane = static_cast<std::uint32_t>(planes.size());
      for (const Plane& f : faces) planes.push_back({f.normal, f.offset + by});
      return p;
    }
    case Kind::kEllipticCone:
    case Kind::kEllipticTorus:
    case Kind::kQuadric:
    case Kind::kMesh: return std::nullopt;
  }
  return std::nullopt;
}

Aabb dilated_bounds(const Primitive& p, double by) {
  const auto across = [&] { return by * stretch(p.to_local, 2); };
  const auto along = [&](int axis) { return by * length(p.to_local.row(axis)); };
  switch (p.kind) {
    case Kind::kEllipsoid:
    case Kind::kTorus: {
      const double all = by * stretch(p.to_local, 3);
      return grown_bounds(p, {all, all, all});
    }
    case Kind::kParallelepiped: return grown_bounds(p, {along(0), along(1), along(2)});
    case Kind::kCylinder: return grown_bounds(p, {across(), across(), along(2)});
    case Kind::kCone: {
      // Below its larger end it goes on growing.
      const double wider = across() + 2 * std::fabs(p.v[5]) * along(2);
      return grown_bounds(p, {wider, wider, along(2)});
    }
    default: return p.bounds.grown(by);
  }
}

/// One scene from another, leaf by leaf.
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
  /// By leaf of the tree under way.
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
// A smaller solid never fills space.
Model eroded(const Model& model, const ObjectDistance& by) {
  return *Resizing(model, by, false).run();
}

}  // namespace graycube
