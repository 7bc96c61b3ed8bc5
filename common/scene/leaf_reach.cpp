#include "scene/leaf_reach.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

namespace graycube {
namespace {

Vec3 absolute(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }
Vec3 larger_of(const Vec3& a, const Vec3& b) {
  return {std::max(std::fabs(a.x), std::fabs(b.x)), std::max(std::fabs(a.y), std::fabs(b.y)),
          std::max(std::fabs(a.z), std::fabs(b.z))};
}
Vec3 all(double v) { return {v, v, v}; }

LeafReach along_axis(const Vec3& base, const Vec3& top, const Vec3& beside) {
  const Vec3 ends = larger_of(base, top);
  const double length_of_axis = length(top - base);
  return {ends + beside, 1 + (length_of_axis > 0 ? max_abs(ends) / length_of_axis : 0.0)};
}

LeafReach reach(const SphereShape& s) { return {absolute(s.center) + all(s.radius), 1}; }
LeafReach reach(const BoxShape& s) { return {larger_of(s.min, s.max), 1}; }
LeafReach reach(const CylinderShape& s) { return along_axis(s.base, s.top, all(s.radius)); }
LeafReach reach(const ConeShape& s) {
  return along_axis(s.base, s.top, all(std::max(s.base_radius, s.top_radius)));
}
LeafReach reach(const TorusShape& s) { return {absolute(s.center) + all(s.major + s.minor), 1}; }
LeafReach reach(const HalfSpaceShape& s) {
  const double square = dot(s.normal, s.normal);
  return {absolute((s.offset / square) * s.normal), 1};
}
LeafReach reach(const EllipsoidShape& s) {
  return {absolute(s.center) + absolute(s.axes[0]) + absolute(s.axes[1]) + absolute(s.axes[2]), 1};
}
LeafReach reach(const EllipticConeShape& s) {
  const double widest = std::max(1.0, std::max(s.top_a, s.top_b));
  return along_axis(s.base, s.top, widest * (absolute(s.a) + absolute(s.b)));
}
LeafReach reach(const EllipticTorusShape& s) {
  return {absolute(s.center) +
              all(s.radius + std::fabs(s.outward) + std::fabs(s.upward) + std::fabs(s.across)),
          1};
}
LeafReach reach(const QuadricShape& s) { return {larger_of(s.min, s.max), 1}; }
LeafReach reach(const MeshShape& s) {
  Vec3 most;
  for (const Vec3& p : s.mesh.points) most = larger_of(most, p);
  return {most, 1};
}
Vec3 reach_across(const OutlineLoops& outline) {
  Vec3 most;
  for (const OutlineLoop& loop : outline) {
    for (const OutlinePoint& p : loop) most = larger_of(most, {p.x, p.y, 0});
  }
  return most;
}
LeafReach reach(const LatheShape& s) {
  const Vec3 most = reach_across(s.outline);
  return {{most.x, most.x, most.y}, 1};
}
LeafReach reach(const SweepShape& s) {
  return {larger_of(reach_across(s.outline), {0, 0, std::fabs(s.base) + s.height}), 1};
}

/// A polyhedron's reach is that of its bounds in the world, mapped back; that of an unbounded one
/// is that of the points of its planes nearest to the origin.
LeafReach reach(const PolyhedronShape& s, const Primitive& built, const Affine& to_world) {
  Vec3 most;
  const auto inverse = built.bounds.is_finite() ? to_world.inverse() : std::nullopt;
  if (inverse) {
    for (int i = 0; i < 8; ++i) most = larger_of(most, inverse->point(built.bounds.corner(i)));
  } else {
    for (const HalfSpaceShape& face : s.planes) most = larger_of(most, reach(face).most);
  }
  return {most, 1};
}

}  // namespace

LeafReach reach_of(const CsgNode& leaf, const Primitive& built, const Affine& to_world) {
  return std::visit(
      [&](const auto& shape) -> LeafReach {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, PolyhedronShape>) {
          return reach(shape, built, to_world);
        } else if constexpr (std::is_same_v<Shape, OperationNode> ||
                             std::is_same_v<Shape, ReferenceNode> ||
                             std::is_same_v<Shape, RepeatNode> ||
                             std::is_same_v<Shape, PrismShape> ||
                             std::is_same_v<Shape, BezierShape>) {
          return {};
        } else {
          return reach(shape);
        }
      },
      leaf.value);
}

}  // namespace graycube
