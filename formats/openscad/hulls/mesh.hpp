// Closed polygon meshes, as of OpenSCAD's polyhedron() and its few-sided cylinders and spheres, and
// the half-spaces of convex ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/close_mesh.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Faces are cycles of indices into `points`, turned either way.
struct ScadMesh {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
};

PolygonMesh polygons_of(const ScadMesh& mesh);

/// Convex solids of more faces become meshes: a ray tests every face of a polyhedron.
inline constexpr std::size_t kMaxPolyhedronFaces = 64;

/// Exactly one is set: planes (outward unit normals), a problem, or flat.
struct ConvexPlanes {
  std::vector<HalfSpaceShape> planes;
  /// Why the mesh isn't the surface of a convex solid; follows "polyhedron() ".
  std::string problem;
  /// The mesh encloses no volume.
  bool flat = false;
};

/// How far coordinates may be off, as a part of them: once they were written with six digits (a
/// point and the plane in which it lies are each off by up to 5e-6), and if they only were
/// computed.
inline constexpr double kSixDigitPrecision = 1e-5;
inline constexpr double kComputedPrecision = 1e-12;

/// The planes of a convex mesh, coplanar faces merged. Every index must be in range, every
/// coordinate finite and at most kMaxOpenscadCoordinate. Points count as lying on a plane within
/// the precision; which side of a face is outside is seen from the other points.
ConvexPlanes convex_planes(const ScadMesh& mesh, double precision = kSixDigitPrecision);

/// The points that faces use, in the order of their first use.
std::vector<Vec3> used_points(const ScadMesh& mesh);

/// The mesh that OpenSCAD builds for cylinder(): prisms, frusta and pyramids of `sides` ≥ 3 sides
/// about z, the first corner at angle 0; one of the radii may be zero.
ScadMesh faceted_cylinder(double z_low, double z_high, double r_low, double r_high, int sides);

/// The mesh that OpenSCAD builds for sphere(): (sides + 1) / 2 rings of `sides` ≥ 3 corners at the
/// polar angles 180° (i + ½) / rings, and a flat cap at each pole.
ScadMesh faceted_sphere(double radius, int sides);

}  // namespace graycube
