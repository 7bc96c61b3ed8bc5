#include "formats/pov/scene_membership.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "mesh/line.hpp"
#include "outline/outline.hpp"
#include "scene/bezier_solid.hpp"
#include "scene/flat_solids.hpp"
#include "scene/repeat.hpp"

namespace graycube {
namespace {

bool holds(const Scene& scene, const CsgNode& node, Vec3 p);

/// The height of p above `base` along the axis to `top`, as a fraction, and its distance from the
/// axis.
struct AxialPosition {
  double height, distance;
};
AxialPosition along_axis(const Vec3& base, const Vec3& top, const Vec3& p) {
  const Vec3 axis = top - base;
  const double height = dot(p - base, axis) / dot(axis, axis);
  return {height, length(p - base - height * axis)};
}

bool value_holds(const Scene& scene, const OperationNode& o, const Vec3& p) {
  const auto inside = [&](const CsgNode& child) { return holds(scene, child, p); };
  const auto first = o.children.begin(), last = o.children.end();
  switch (o.operation) {
    case Operation::kUnion: return std::any_of(first, last, inside);
    case Operation::kIntersection: return std::all_of(first, last, inside);
    case Operation::kDifference: return inside(*first) && std::none_of(first + 1, last, inside);
    case Operation::kComplement: return !inside(*first);
  }
  return false;
}
bool value_holds(const Scene& scene, const ReferenceNode& r, const Vec3& p) {
  return holds(scene, scene.shapes[r.shape].node, p);
}
bool value_holds(const Scene& scene, const RepeatNode& r, const Vec3& p) {
  bool inside = false;
  for_each_copy(r, Affine{}, [&](const Affine& map, std::size_t) {
    const auto inverse = inside ? std::nullopt : map.inverse();
    inside = inside || (inverse && holds(scene, r.child.front(), inverse->point(p)));
  });
  return inside;
}
bool value_holds(const Scene&, const SphereShape& s, const Vec3& p) {
  return length(p - s.center) <= s.radius;
}
bool value_holds(const Scene&, const BoxShape& b, const Vec3& p) {
  return p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y && p.z >= b.min.z &&
         p.z <= b.max.z;
}
bool value_holds(const Scene&, const CylinderShape& c, const Vec3& p) {
  const auto [height, distance] = along_axis(c.base, c.top, p);
  return height >= 0 && height <= 1 && distance <= c.radius;
}
bool value_holds(const Scene&, const ConeShape& c, const Vec3& p) {
  const auto [height, distance] = along_axis(c.base, c.top, p);
  return height >= 0 && height <= 1 &&
         distance <= c.base_radius + height * (c.top_radius - c.base_radius);
}
bool value_holds(const Scene&, const TorusShape& t, const Vec3& p) {
  const Vec3 axis = normalized(t.axis);
  const double height = dot(p - t.center, axis);
  const double outwards = length(p - t.center - height * axis) - t.major;
  return outwards * outwards + height * height <= t.minor * t.minor;
}
bool value_holds(const Scene&, const HalfSpaceShape& h, const Vec3& p) {
  return dot(h.normal, p) <= h.offset;
}
bool value_holds(const Scene&, const EllipsoidShape& e, const Vec3& p) {
  // q of p = center + A q, by Cramer's rule; the axes are A's columns.
  const Vec3 d = p - e.center;
  const auto& [a, b, c] = e.axes;
  const double whole = dot(a, cross(b, c));
  const Vec3 q{dot(d, cross(b, c)) / whole, dot(a, cross(d, c)) / whole,
               dot(a, cross(b, d)) / whole};
  return length(q) <= 1;
}
/// The coordinates of p on three axes, by Cramer's rule.
Vec3 coordinates(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const double whole = dot(a, cross(b, c));
  return {dot(p, cross(b, c)) / whole, dot(a, cross(p, c)) / whole, dot(a, cross(b, p)) / whole};
}
bool value_holds(const Scene&, const EllipticConeShape& s, const Vec3& p) {
  const Vec3 q = coordinates(s.a, s.b, s.top - s.base, p - s.base);
  const double x = 1 + q.z * (s.top_a - 1), y = 1 + q.z * (s.top_b - 1);
  const double u = q.x * y, v = q.y * x;
  return q.z >= 0 && q.z <= 1 && u * u + v * v <= x * x * y * y;
}
bool value_holds(const Scene&, const EllipticTorusShape& t, const Vec3& p) {
  const Vec3 axis = normalized(t.axis);
  const double height = dot(p - t.center, axis);
  const double outwards = length(p - t.center - height * axis) - t.radius;
  const double m = std::sqrt(t.outward * t.outward + t.upward * t.upward);
  const double along = (outwards * t.outward + height * t.upward) / (m * m);
  const double beside = (height * t.outward - outwards * t.upward) / (m * t.across);
  return along * along + beside * beside <= 1;
}
bool value_holds(const Scene&, const QuadricShape& s, const Vec3& p) {
  const auto& q = s.coefficients;
  return Aabb{s.min, s.max}.contains(p) &&
         p.x * p.x + q[0] * p.y * p.y + (q[1] * p.z + q[2]) * p.z + q[3] <= 0;
}
bool value_holds(const Scene&, const MeshShape& m, const Vec3& p) {
  const Ray ray{p, {0.36, 0.48, 0.8}};
  const csg::MeshLine line(ray);
  const auto& points = m.mesh.points;
  int winding = 0;
  for (const auto& [a, b, c] : m.mesh.triangles) {
    const int count = csg::triangle_count(line, points[a], points[b], points[c]);
    if (count != 0 && csg::triangle_parameter(line, ray, points[a], points[b], points[c]) < 0)
      winding += count;
  }
  return winding != 0;
}
bool value_holds(const Scene& scene, const BezierShape& s, const Vec3& p) {
  auto mesh = mesh_of(s);
  auto* surface = std::get_if<TriangleMesh>(&mesh);
  return surface != nullptr && value_holds(scene, MeshShape{std::move(*surface), 0}, p);
}
bool value_holds(const Scene& scene, const PolyhedronShape& s, const Vec3& p) {
  return std::all_of(s.planes.begin(), s.planes.end(),
                     [&](const HalfSpaceShape& plane) { return value_holds(scene, plane, p); });
}
bool value_holds(const Scene&, const PrismShape& s, const Vec3& p) {
  return p.z >= s.base && p.z <= s.base + s.height && is_within(loops_of(s), {p.x, p.y});
}

bool value_holds(const Scene&, const LatheShape& s, const Vec3& p) {
  return Outline(s.outline).contains({std::sqrt(p.x * p.x + p.y * p.y), p.z});
}
bool value_holds(const Scene&, const SweepShape& s, const Vec3& p) {
  return p.z >= s.base && p.z <= s.base + s.height && Outline(s.outline).contains({p.x, p.y});
}

bool holds(const Scene& scene, const CsgNode& node, Vec3 p) {
  if (node.transform) {
    const auto inverse = node.transform->inverse();
    if (!inverse) return false;
    p = inverse->point(p);
  }
  return std::visit([&](const auto& value) { return value_holds(scene, value, p); }, node.value);
}

}  // namespace

bool any_object_holds(const Scene& scene, const Vec3& point) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const SceneObject& o) { return holds(scene, o.csg, point); });
}

}  // namespace graycube
