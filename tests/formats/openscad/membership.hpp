// Which points a scene's solids hold, computed from the scene values alone: an oracle that shares
// no code with the renderer.
#pragma once

#include <algorithm>
#include <variant>

#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace graycube::testing {

inline bool holds(const CsgNode& node, const Vec3& world);

/// An oracle for the shapes that the OpenSCAD reader makes.
struct Holds {
  Vec3 p;

  bool operator()(const SphereShape& s) const { return length(p - s.center) <= s.radius; }
  bool operator()(const BoxShape& s) const {
    return p.x >= s.min.x && p.x <= s.max.x && p.y >= s.min.y && p.y <= s.max.y && p.z >= s.min.z &&
           p.z <= s.max.z;
  }
  bool operator()(const ConeShape& s) const {
    const Vec3 axis = s.top - s.base;
    const double h = dot(p - s.base, axis) / dot(axis, axis);
    const double radius = s.base_radius + h * (s.top_radius - s.base_radius);
    return h >= 0 && h <= 1 && length(p - s.base - h * axis) <= radius;
  }
  bool operator()(const CylinderShape& s) const {
    return (*this)(ConeShape{s.base, s.radius, s.top, s.radius});
  }
  bool operator()(const PolyhedronShape& s) const {
    return std::all_of(s.planes.begin(), s.planes.end(), [&](const HalfSpaceShape& plane) {
      return dot(plane.normal, p) <= plane.offset;
    });
  }
  bool operator()(const OperationNode& n) const {
    const auto in = [&](const CsgNode& child) { return holds(child, p); };
    switch (n.operation) {
      case Operation::kUnion: return std::any_of(n.children.begin(), n.children.end(), in);
      case Operation::kIntersection: return std::all_of(n.children.begin(), n.children.end(), in);
      case Operation::kDifference:
        return in(n.children.front()) && std::none_of(n.children.begin() + 1, n.children.end(), in);
      case Operation::kComplement: return !in(n.children.front());
    }
    return false;
  }
  template <typename Other>
  bool operator()(const Other&) const {
    return false;
  }
};

inline bool holds(const CsgNode& node, const Vec3& world) {
  Vec3 p = world;
  if (node.transform) p = node.transform->inverse().value().point(world);
  return std::visit(Holds{p}, node.value);
}

inline bool holds(const Scene& scene, const Vec3& p) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const SceneObject& object) { return holds(object.csg, p); });
}

}  // namespace graycube::testing
