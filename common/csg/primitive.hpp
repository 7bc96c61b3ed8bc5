// A primitive: one leaf of a CSG tree, in world coordinates, ready to be intersected. Solving,
// bounding and classifying each kind lives in one file per kind; this is what they share.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "geometry/plane.hpp"
#include "geometry/ray.hpp"
#include "geometry/spans.hpp"
#include "mesh/mesh.hpp"

namespace graycube {

enum class PrimitiveKind : std::uint8_t {
  kSphere,          // v[0..2] centre, v[3] radius
  kEllipsoid,       // to_local maps it to the unit sphere
  kBox,             // v[0..2] lower corner, v[3..5] upper corner, world axes
  kParallelepiped,  // to_local, whose rows are unit normals, maps it to the box v[0..2] … v[3..5]
  kCylinder,  // to_local: x² + y² ≤ 1; world cap planes in v: normal 0..2, lower 3, upper 4 offset
  kCone,  // as kCylinder with x² + y² ≤ (1 + v[5] z)², v[5] < 0, on the nappe with 1 + v[5] z ≥ 0
  kTorus,       // to_local: major radius 1 about z, minor radius v[0]
  kHalfSpace,   // v[0..2] normal, v[3] offset: the points with normal · p ≤ offset
  kPolyhedron,  // planes[first_plane, first_plane + plane_count): normal · p ≤ offset for each
  kEllipticCone,  // caps as kCone; to_local: x² / (1 − z)² + y² / (1 − v[5] z)² ≤ 1 between them
  kEllipticTorus,  // to_local, ρ² = x² + y²: v[0] (ρ−1)² + 2 v[1] (ρ−1) z + v[2] z² ≤ 1; reaches
                   // v[3] and v[4] far
  kQuadric,  // to_local: x² + v[0] y² + v[1] z² + v[2] z + v[3] ≤ 0; and planes as kPolyhedron
  kMesh,     // meshes[mesh]
};
inline constexpr int kPrimitiveKinds = 13;

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::kSphere;
  std::uint32_t material = 0;
  std::uint32_t first_plane = 0;
  std::uint32_t plane_count = 0;
  std::uint32_t mesh = 0;
  std::array<double, 6> v{};
  /// World → local; unused by kinds that work in world coordinates.
  Affine to_local;
  /// Encloses the solid; infinite where it is unbounded.
  Aabb bounds;

  friend bool operator==(const Primitive&, const Primitive&) = default;
};

/// What primitives keep elsewhere.
struct PrimitiveData {
  PrimitiveData(std::span<const Plane> all_planes, std::span<const Mesh> all_meshes)
      : planes(all_planes), meshes(all_meshes) {}
  /// For primitives other than meshes.
  PrimitiveData(const std::vector<Plane>& all_planes) : planes(all_planes) {}  // NOLINT: implicit

  std::span<const Plane> planes;
  std::span<const Mesh> meshes;
};

/// The whole line's intervals, negative parameters too, never clipped. −0 is given as +0.
Spans spans_along(const Primitive& primitive, const PrimitiveData& data, const Ray& ray);

/// Closed-set membership of a point, up to rounding.
bool contains(const Primitive& primitive, const PrimitiveData& data, const Vec3& point);

/// The unit normal pointing out of the primitive at parameter `t` of `ray`, where t is one of the
/// ends that spans_along gave for the same ray: the face is the one whose root is t.
Vec3 outward_normal(const Primitive& primitive, const PrimitiveData& data, const Ray& ray,
                    double t);

/// Where a cell lies: wholly outside the primitive, wholly inside, or perhaps crossed by its
/// surface. Conservative: only kCrosses may be wrong. The cell must be grown by the scene's δ
/// already; touching counts as crossing. Cells may be unbounded.
CellSide classify(const Primitive& primitive, const PrimitiveData& data, const Aabb& cell);

}  // namespace graycube
