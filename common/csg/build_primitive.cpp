#include "csg/build_primitive.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "csg/box.hpp"
#include "csg/elliptic_cone.hpp"
#include "csg/elliptic_torus.hpp"
#include "csg/quadric.hpp"
#include "csg/soundness.hpp"
#include "csg/sphere.hpp"
#include "csg/torus.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {
namespace {

/// All NaN for a map without an inverse, which why_unsound() then finds.
Affine inverse_of(const Affine& map) {
  if (const auto inverse = map.inverse()) return *inverse;
  Affine none;
  for (auto& row : none.m) row.fill(std::numeric_limits<double>::quiet_NaN());
  return none;
}

/// The inverse of the map that applies `frame`, then `to_world`. Each of the two may have one where
/// their product is too ill-conditioned: a wide disc in space that is stretched across it.
Affine inverse_of(const Affine& to_world, const Affine& frame) {
  if (const auto inverse = compose(to_world, frame).inverse()) return *inverse;
  return compose(inverse_of(frame), inverse_of(to_world));
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

/// The unit vector along `v`; all NaN where its length is none or beyond doubles.
Vec3 unit_or_nan(const Vec3& v) {
  const double l = length(v);
  if (l > 0 && std::isfinite(l)) return normalized(v);
  return std::numeric_limits<double>::quiet_NaN() * Vec3{1, 1, 1};
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

/// Caps at local z = 0 and z = 1 as planes of the world, through the ends as the scene gives them:
/// base + (top − base) may miss top by a bit, and a cap flush with another face would not be.
void set_caps(Primitive& p, const Vec3& world_base, const Vec3& world_top) {
  const Vec3 normal = unit_or_nan(p.to_local.row(2));
  csg::set_caps(p, normal + Vec3{}, dot(normal, world_base), dot(normal, world_top));
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
  p.v = csg::sphere_slots(c, r);
  p.bounds = around(c, {r, r, r});
  return p;
}

Primitive build_ellipsoid(const Affine& to_world, const Vec3& center,
                          const std::array<Vec3, 3>& axes) {
  const Affine local = frame(axes[0], axes[1], axes[2], center);
  const Affine map = compose(to_world, local);
  Primitive p;
  p.kind = PrimitiveKind::kEllipsoid;
  p.to_local = inverse_of(to_world, local);
  p.bounds =
      around(map.translation(), {length(map.row(0)), length(map.row(1)), length(map.row(2))});
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
    p.v = csg::box_slots(p.bounds.lo, p.bounds.hi);
    return p;
  }
  const Vec3 e = hi - lo;
  const Affine local = frame({e.x, 0, 0}, {0, e.y, 0}, {0, 0, e.z}, lo);
  const Affine map = compose(to_world, local);
  p.kind = PrimitiveKind::kParallelepiped;
  const Affine inverse = inverse_of(to_world, local);
  const Vec3 low = to_world.point(lo), high = to_world.point(hi);
  Vec3 local_low, local_high;
  for (int a = 0; a < 3; ++a) {
    const Vec3 n = unit_or_nan(inverse.row(a)) + Vec3{};
    p.to_local.m[static_cast<std::size_t>(a)] = {n.x, n.y, n.z, 0};
    local_low[a] = dot(n, low) + 0.0;
    local_high[a] = dot(n, high) + 0.0;
  }
  p.v = csg::box_slots(local_low, local_high);
  p.bounds = Aabb::nothing();
  for (int i = 0; i < 8; ++i) p.bounds.include(map.point(Aabb{{0, 0, 0}, {1, 1, 1}}.corner(i)));
  return p;
}

Primitive build_cylinder(const Affine& to_world, const Vec3& base, const Vec3& top, double radius) {
  const Vec3 axis = top - base;
  const Affine local = frame_about(base, normalized(axis), radius, length(axis));
  const Affine map = compose(to_world, local);
  Primitive p;
  p.kind = PrimitiveKind::kCylinder;
  p.to_local = inverse_of(to_world, local);
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
  const Affine local = frame_about(base, normalized(axis), base_radius, length(axis));
  const Affine map = compose(to_world, local);
  const double top_share = top_radius / base_radius;
  Primitive p;
  p.kind = PrimitiveKind::kCone;
  p.to_local = inverse_of(to_world, local);
  set_caps(p, to_world.point(base), to_world.point(top));
  csg::set_cone_slope(p, top_share - 1);
  const Vec3 extent = disc_extent(map);
  p.bounds = union_of(around(map.point({0, 0, 0}), extent),
                      around(map.point({0, 0, 1}), top_share * extent));
  return p;
}

Primitive build_torus(const Affine& to_world, const Vec3& center, const Vec3& axis, double major,
                      double minor) {
  const Affine local = frame_about(center, normalized(axis), major, major);
  const Affine map = compose(to_world, local);
  Primitive p;
  p.kind = PrimitiveKind::kTorus;
  p.to_local = inverse_of(to_world, local);
  p.v = csg::torus_slots(minor / major);
  const Vec3 ring = disc_extent(map);
  const Vec3 tube{length(map.row(0)), length(map.row(1)), length(map.row(2))};
  p.bounds = around(map.translation(), ring + csg::torus_minor(p) * tube);
  return p;
}

Primitive build_half_space(const Affine& to_world, const Plane& plane) {
  const Plane world = mapped_plane(inverse_of(to_world), plane);
  Primitive p;
  p.kind = PrimitiveKind::kHalfSpace;
  p.v = csg::half_space_slots(world);
  p.bounds = csg::half_space_bounds(world);
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

Primitive build_elliptic_cone(const Affine& to_world, const Vec3& base, const Vec3& top,
                              const Vec3& a, const Vec3& b, double top_a, double top_b) {
  const Vec3 axis = top - base;
  if (top_a == top_b) {
    return build_cone(compose(to_world, frame(a, b, axis, base)), {0, 0, 0}, 1, {0, 0, 1}, top_a);
  }
  // The axis that changes more sets the frame's height, so that k is at most 1.
  if (std::fabs(1 - top_b) > std::fabs(1 - top_a)) {
    return build_elliptic_cone(to_world, base, top, b, a, top_b, top_a);
  }
  const double height = 1 - top_a;
  const Affine local = frame(a, b, axis, base);
  const Affine map = compose(to_world, local);
  Primitive p;
  p.kind = PrimitiveKind::kEllipticCone;
  p.to_local = inverse_of(to_world, local);
  for (double& v : p.to_local.m[2]) v *= height;
  set_caps(p, to_world.point(base), to_world.point(top));
  if (csg::lower_cap(p) > csg::upper_cap(p)) {
    csg::set_caps(p, -csg::cap_normal(p) + Vec3{}, -csg::lower_cap(p), -csg::upper_cap(p));
  }
  csg::set_second_slope(p, (1 - top_b) / height);
  Vec3 top_extent;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = map.row(i);
    top_extent[i] = std::sqrt(r.x * r.x * top_a * top_a + r.y * r.y * top_b * top_b);
  }
  p.bounds = union_of(around(map.point({0, 0, 0}), disc_extent(map)),
                      around(map.point({0, 0, 1}), top_extent));
  return p;
}

Primitive build_elliptic_torus(const Affine& to_world, const Vec3& center, const Vec3& axis,
                               double radius, double outward, double upward, double across) {
  const Affine local = frame_about(center, normalized(axis), radius, radius);
  const Affine map = compose(to_world, local);
  const double m = std::sqrt(outward * outward + upward * upward);
  const double c = outward / m, s = upward / m;
  const double major = m / radius, minor = across / radius;
  const double i2 = 1 / (major * major), j2 = 1 / (minor * minor);
  Primitive p;
  p.kind = PrimitiveKind::kEllipticTorus;
  p.to_local = inverse_of(to_world, local);
  // The ellipse's reach in direction (u, w) of its plane.
  const auto reach = [&](double u, double w) {
    const double along = major * (c * u + s * w), beside = minor * (c * w - s * u);
    return std::sqrt(along * along + beside * beside);
  };
  const Vec3 ellipse{c * c * i2 + s * s * j2, c * s * (i2 - j2), s * s * i2 + c * c * j2};
  p.v = csg::elliptic_torus_slots(ellipse, reach(1, 0), reach(0, 1));
  const Vec3 ring = disc_extent(map);
  Vec3 extent;
  for (int i = 0; i < 3; ++i) {
    const double z = map.row(i).z;
    extent[i] = ring[i] + std::fmax(reach(ring[i], z), reach(ring[i], -z));
  }
  p.bounds = around(map.translation(), extent);
  return p;
}

namespace {

/// Bounds of a quadric's slice between two heights: those of an ellipse, or rectangle, around
/// it.
Aabb slice_bounds(const Affine& map, const std::array<double, 4>& q, const Vec3& lo, const Vec3& hi,
                  double z0, double z1) {
  const auto radius2 = [&](double z) { return -((q[1] * z + q[2]) * z + q[3]); };
  double most = std::fmax(radius2(z0), radius2(z1));
  const double turn = q[1] != 0 ? -q[2] / (2 * q[1]) : z0;
  if (turn > z0 && turn < z1) most = std::fmax(most, radius2(turn));
  if (!(most >= 0)) return Aabb::nothing();
  const double a = std::sqrt(most);
  Aabb box;
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = map.row(i);
    const double middle = map.translation()[i] + 0.5 * (z0 + z1) * r.z;
    const double slope = 0.5 * (z1 - z0) * std::fabs(r.z);
    double below = 0, above = 0;
    if (q[0] > 0) {
      below = above = std::sqrt(r.x * r.x * most + r.y * r.y * most / q[0]);
    } else {
      below = std::fabs(r.x) * a - std::fmin(r.y * lo.y, r.y * hi.y);
      above = std::fabs(r.x) * a + std::fmax(r.y * lo.y, r.y * hi.y);
    }
    box.lo[i] = middle - slope - below;
    box.hi[i] = middle + slope + above;
  }
  return box;
}

}  // namespace

Primitive build_quadric(const Affine& to_world, const std::array<double, 4>& q, const Vec3& lo,
                        const Vec3& hi, std::vector<Plane>& planes) {
  constexpr int kSlices = 32;
  Primitive p;
  p.kind = PrimitiveKind::kQuadric;
  p.to_local = inverse_of(to_world);
  p.v = csg::quadric_slots(q);
  p.first_plane = static_cast<std::uint32_t>(planes.size());
  p.plane_count = 6;
  Aabb corners = Aabb::nothing();
  for (int i = 0; i < 8; ++i) corners.include(to_world.point(Aabb{lo, hi}.corner(i)));
  for (int a = 0; a < 3; ++a) {
    Vec3 n;
    n[a] = 1;
    planes.push_back(mapped_plane(p.to_local, {n, hi[a]}));
    planes.push_back(mapped_plane(p.to_local, {-n, -lo[a]}));
  }
  Aabb slices = Aabb::nothing();
  for (int i = 0; i < kSlices; ++i) {
    const double z0 = lo.z + (hi.z - lo.z) * i / kSlices;
    const double z1 = lo.z + (hi.z - lo.z) * (i + 1) / kSlices;
    slices = union_of(slices, slice_bounds(to_world, q, lo, hi, z0, z1));
  }
  p.bounds = intersection_of(
      corners, slices.is_empty() ? corners : slices.grown(1e-12 * length(corners.hi - corners.lo)));
  return p;
}

Primitive build_mesh(const Affine& to_world, const TriangleMesh& mesh, std::vector<Mesh>& meshes) {
  TriangleMesh surface = mesh;
  Aabb bounds = Aabb::nothing();
  bool finite = true;
  for (Vec3& p : surface.points) {
    p = to_world.point(p) + Vec3{0, 0, 0};
    bounds.include(p);
    finite = finite && is_finite(p);
  }
  Primitive p;
  p.kind = PrimitiveKind::kMesh;
  p.mesh = static_cast<std::uint32_t>(meshes.size());
  p.bounds = bounds;
  if (!finite || !is_within_range(bounds)) {
    p.v.fill(std::numeric_limits<double>::quiet_NaN());
    return p;
  }
  if (to_world.determinant() < 0) turn_inside_out(surface);
  meshes.emplace_back(std::move(surface));
  p.bounds = meshes.back().bounds();
  return p;
}

}  // namespace graycube
