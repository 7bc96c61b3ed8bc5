// Makes primitives from the shapes of a scene file under an affine map. A shape that stays simple
// stays simple: a sphere under a similarity is a sphere, a box turned by 90° is still along the
// axes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "csg/primitive.hpp"
#include "mesh/mesh.hpp"

namespace graycube {

/// All these take the map from the shape's coordinates to the world (invertible) and valid shape
/// parameters (read_scene's limits); `material` is left 0.
Primitive build_sphere(const Affine& to_world, const Vec3& center, double radius);
/// The image of the unit sphere under linearly independent axes, moved to `center`.
Primitive build_ellipsoid(const Affine& to_world, const Vec3& center,
                          const std::array<Vec3, 3>& axes);
Primitive build_box(const Affine& to_world, const Vec3& lo, const Vec3& hi);
Primitive build_cylinder(const Affine& to_world, const Vec3& base, const Vec3& top, double radius);
/// One of the radii may be zero; equal radii give a cylinder.
Primitive build_cone(const Affine& to_world, const Vec3& base, double base_radius, const Vec3& top,
                     double top_radius);
Primitive build_torus(const Affine& to_world, const Vec3& center, const Vec3& axis, double major,
                      double minor);
Primitive build_half_space(const Affine& to_world, const Plane& plane);
/// Appends the faces, in world coordinates and with unit normals, to `planes`.
Primitive build_polyhedron(const Affine& to_world, std::span<const Plane> faces,
                           std::vector<Plane>& planes);

/// A solid between the ellipse with semi-axes a, b about `base` and the one with top_a · a, top_b ·
/// b about `top`; a, b and top − base are independent, and one of top_a, top_b (≥ 0) is above 0 or
/// both are 0. Round ones become cones and cylinders.
Primitive build_elliptic_cone(const Affine& to_world, const Vec3& base, const Vec3& top,
                              const Vec3& a, const Vec3& b, double top_a, double top_b);
/// An ellipse about the end of a radius across `axis`, turned about it: one semi-axis reaches
/// `outward` along the radius and `upward` along the axis, the other is `across` long and
/// perpendicular. It must not reach the axis.
Primitive build_elliptic_torus(const Affine& to_world, const Vec3& center, const Vec3& axis,
                               double radius, double outward, double upward, double across);
/// The points of the box lo … hi with x² + q[0] y² + q[1] z² + q[2] z + q[3] ≤ 0, q[0] ≥ 0. Appends
/// its faces to `planes`.
Primitive build_quadric(const Affine& to_world, const std::array<double, 4>& q, const Vec3& lo,
                        const Vec3& hi, std::vector<Plane>& planes);
/// Appends the mesh, in world coordinates and turned over where the map mirrors, to `meshes`. It
/// must be closed.
Primitive build_mesh(const Affine& to_world, const TriangleMesh& mesh, std::vector<Mesh>& meshes);

}  // namespace graycube
