#include "csg/build_primitive.hpp"

#include <cmath>

#include "csg/half_space.hpp"
#include "geometry/check.hpp"

namespace graycube {
namespace {

Affine inverse_of(const Affine& map) {
  const auto inverse = map.inverse();
  GRAYCUBE_CHECK(inverse.has_value(), "a primitive's map is singular");
  return *inverse;
}

/// The map whose columns are x, y, z and the translation `origin`.
Affine frame(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  Affine f;
  for (int i = 0; i < 3; ++i) f.m[static_cast<std::size_t>(i)] = {x[i], y[i], z[i], origin[i]};
  return f;
}

/// A unit vector perpendicular to the unit vector a; along a world axis whenever a is.
Vec3 perpendicular(const Vec3& a) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::fabs(a[i]) < std::fabs(a[least])) least = i;
  }
  Vec3 e;
  e[least] = 1;
  return normalized(cross(a, e));
}

/// A right-handed frame with z along `axis` (unit) and lengths as given.
Affine frame_about(const Vec3& origin, const Vec3& axis, double radial, double axial) {
  const Vec3 x = perpendicular(axis);
  const Vec3 y = cross(axis, x);
  return frame(radial * x, radial * y, axial * axis, origin);
}

/// Half the extent, along each world axis, of the image of the unit disc in the local x-y plane.
Vec3 disc_extent(const Affine& to_world) {
  Vec3 e;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = to_world.row(i);
    e[i] = std::sqrt(r.x * r.x + r.y * r.y);
  }
  return e;
}

Aabb around(const Vec3& center, const Vec3& extent) { return {center - extent, center + extent}; }

/// Caps at local z = 0 and z = 1 as planes of the world, through the ends as the scene gives them: base +
/// (top − base) may miss top by a bit, and a cap flush with another face would not be.
void set_caps(Primitive& p, const Vec3& world_base, const Vec3& world_top) {
  const Vec3 normal = normalized(p.to_local.row(2));
  for (int i = 0; i < 3; ++i) p.v[static_cast<std::size_t>(i)] = normal[i] + 0.0;
  p.v[3] = dot(normal, world_base);
  p.v[4] = dot(normal, world_top);
}

/// The plane's image: normals go by the inverse transposed.
Plane mapped_plane(const Affine& inverse, const Plane& plane) {
  const Vec3 normal = inverse.transposed_vector(plane.normal);
  const double offset = plane.offset - dot(plane.normal, inverse.translation());
  const double l = length(normal);
  return {{normal.x / l + 0.0, normal.y / l + 0.0, normal.z / l + 0.0}, offset / l};
}

/// True when every row and column of the linear part has one non-zero entry.
bool keeps_axes(const Affine& map) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = map.row(i);
    if ((r.x != 0) + (r.y != 0) + (r.z != 0) != 1) return false;
  }
  return true;
}

Aabb half_space_bounds(const Plane& plane) {
  Aabb b;
  const Vec3& n = plane.normal;
  for (int a = 0; a < 3; ++a) {
    if (n[a] == 0 || n[(a + 1) % 3] != 0 || n[(a + 2) % 3] != 0) continue;
    (n[a] > 0 ? b.hi[a] : b.lo[a]) = plane.offset / n[a];
  }
  return b;
}

}  // namespace

Primitive build_sphere(const Affine& to_world, const Vec3& center, double radius) {
  const auto scale = to_world.similarity_scale();
  if (!scale) {
    return build_ellipsoid(to_world, center, {Vec3{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}});
  }
  Primitive p;
  p.kind = PrimitiveKind::kSphere;
  const Vec3 c = to_world.point(center);
  const double r = *scale * radius;
  p.v = {c.x, c.y, c.z, r, 0, 0};
  p.bounds = around(c, {r, r, r});
  return p;
}

Primitive build_ellipsoid(const Affine& to_world, const Vec3& center,
                          const std::array<Vec3, 3>& axes) {
  const Affine map = compose(to_world, frame(axes[0], axes[1], axes[2], center));
  Primitive p;
  p.kind = PrimitiveKind::kEllipsoid;
  p.to_local = inverse_of(map);
  p.bounds = around(map.translation(), {length(map.row(0)), length(map.row(1)), length(map.row(2))});
  return p;
}

Primitive build_box(const Affine& to_world, const Vec3& lo, const Vec3& hi) {
  Primitive p;
  if (keeps_axes(to_world)) {
    const Vec3 a = to_world.point(lo);
    const Vec3 b = to_world.point(hi);
    p.kind = PrimitiveKind::kBox;
    p.bounds = Aabb::nothing();
    p.bounds.include(a);
    p.bounds.include(b);
    p.v = {p.bounds.lo.x, p.bounds.lo.y, p.bounds.lo.z, p.bounds.hi.x, p.bounds.hi.y, p.bounds.hi.z};
    return p;
  }
  const Vec3 e = hi - lo;
  const Affine map = compose(to_world, frame({e.x, 0, 0}, {0, e.y, 0}, {0, 0, e.z}, lo));
  p.kind = PrimitiveKind::kParallelepiped;
  p.to_local = inverse_of(map);
  p.bounds = Aabb::nothing();
  for (int i = 0; i < 8; ++i) p.bounds.include(map.point(Aabb{{0, 0, 0}, {1, 1, 1}}.corner(i)));
  return p;
}

Primitive build_cylinder(const Affine& to_world, const Vec3& base, const Vec3& top, double radius) {
  const Vec3 axis = top - base;
  const Affine map =
      compose(to_world, frame_about(base, normalized(axis), radius, length(axis)));
  Primitive p;
  p.kind = PrimitiveKind::kCylinder;
  p.to_local = inverse_of(map);
  set_caps(p, to_world.point(base), to_world.point(top));
  const Vec3 extent = disc_extent(map);
  p.bounds = union_of(around(map.point({0, 0, 0}), extent), around(map.point({0, 0, 1}), extent));
  return p;
}

Primitive build_cone(const Affine& to_world, const Vec3& base, double base_radius, const Vec3& top,
                     double top_radius) {
  if (base_radius == top_radius) return build_cylinder(to_world, base, top, base_radius);
  if (base_radius < top_radius) return build_cone(to_world, top, top_radius, base, base_radius);
  const Vec3 axis = top - base;
  const Affine map =
      compose(to_world, frame_about(base, normalized(axis), base_radius, length(axis)));
  const double top_share = top_radius / base_radius;
  Primitive p;
  p.kind = PrimitiveKind::kCone;
  p.to_local = inverse_of(map);
  set_caps(p, to_world.point(base), to_world.point(top));
  p.v[5] = top_share - 1;
  const Vec3 extent = disc_extent(map);
  p.bounds = union_of(around(map.point({0, 0, 0}), extent),
                      around(map.point({0, 0, 1}), top_share * extent));
  return p;
}

Primitive build_torus(const Affine& to_world, const Vec3& center, const Vec3& axis, double major,
                      double minor) {
  const Affine map = compose(to_world, frame_about(center, normalized(axis), major, major));
  Primitive p;
  p.kind = PrimitiveKind::kTorus;
  p.to_local = inverse_of(map);
  p.v[0] = minor / major;
  const Vec3 ring = disc_extent(map);
  const Vec3 tube{length(map.row(0)), length(map.row(1)), length(map.row(2))};
  p.bounds = around(map.translation(), ring + p.v[0] * tube);
  return p;
}

Primitive build_half_space(const Affine& to_world, const Plane& plane) {
  const Plane world = mapped_plane(inverse_of(to_world), plane);
  Primitive p;
  p.kind = PrimitiveKind::kHalfSpace;
  p.v = {world.normal.x, world.normal.y, world.normal.z, world.offset, 0, 0};
  p.bounds = half_space_bounds(world);
  return p;
}

Primitive build_polyhedron(const Affine& to_world, std::span<const Plane> faces,
                           std::vector<Plane>& planes) {
  const Affine inverse = inverse_of(to_world);
  Primitive p;
  p.kind = PrimitiveKind::kPolyhedron;
  p.first_plane = static_cast<std::uint32_t>(planes.size());
  p.plane_count = static_cast<std::uint32_t>(faces.size());
  for (const Plane& f : faces) planes.push_back(mapped_plane(inverse, f));
  p.bounds = csg::polyhedron_bounds(csg::faces_of(p, planes));
  return p;
}

}  // namespace graycube
