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
#include "outline/placed_outline.hpp"

namespace graycube {

/// The kinds; csg/kinds.hpp lists their differences. The meaning of the slots of `Primitive::v` is
/// given in each kind's own file, which alone reads them by their indices.
enum class PrimitiveKind : std::uint8_t {
  kSphere,
  kEllipsoid,
  kBox,
  kParallelepiped,
  kCylinder,
  kCone,
  kTorus,
  kHalfSpace,
  kPolyhedron,
  kEllipticCone,
  kEllipticTorus,
  kQuadric,
  kMesh,
  kLathe,
  kSweep,
};
inline constexpr int kPrimitiveKinds = 15;

namespace csg {
/// Whether primitives of this kind have an outline.
constexpr bool has_outline(PrimitiveKind kind) {
  return kind == PrimitiveKind::kLathe || kind == PrimitiveKind::kSweep;
}
}  // namespace csg

/// The numbers of a primitive beside its frame and its planes.
using Slots = std::array<double, 6>;

struct Primitive {
  PrimitiveKind kind = PrimitiveKind::kSphere;
  std::uint32_t material = 0;
  std::uint32_t first_plane = 0;
  std::uint32_t plane_count = 0;
  std::uint32_t mesh = 0;
  /// Of a lathe or a sweep; several may share one.
  std::uint32_t outline = 0;
  Slots v{};
  /// World → local; unused by kinds that work in world coordinates.
  Affine to_local;
  /// Encloses the solid; infinite where it is unbounded.
  Aabb bounds;

  friend bool operator==(const Primitive&, const Primitive&) = default;
};

/// The planes, meshes and outlines of a model, to which its primitives refer.
struct PrimitiveData {
  PrimitiveData(std::span<const Plane> all_planes, std::span<const Mesh> all_meshes,
                std::span<const Outline> all_outlines = {})
      : planes(all_planes), meshes(all_meshes), outlines(all_outlines) {}
  /// For primitives without a mesh or an outline.
  PrimitiveData(const std::vector<Plane>& all_planes) : planes(all_planes) {}  // NOLINT: implicit

  std::span<const Plane> planes;
  std::span<const Mesh> meshes;
  std::span<const Outline> outlines;
};

/// The whole line's intervals, negative parameters too, never clipped. −0 is given as +0.
Spans spans_along(const Primitive& primitive, const PrimitiveData& data, const Ray& ray);

/// Closed-set membership of a point, up to rounding.
bool contains(const Primitive& primitive, const PrimitiveData& data, const Vec3& point);

/// The unit normal pointing out of the primitive at parameter `t` of `ray`, where t is one of the
/// ends that spans_along gave for the same ray: the face is the one whose root is t. A tip or a
/// ridge has a normal between those of its sides. Where the ray only touches the surface, in an
/// interval of length zero, the normal is a unit vector still, but may point to either side.
Vec3 outward_normal(const Primitive& primitive, const PrimitiveData& data, const Ray& ray,
                    double t);

/// Tells whether a cell lies wholly outside the primitive, wholly inside, or is perhaps crossed by
/// its surface. Conservative: only kCrosses may be wrong. The cell must be grown by the scene's δ
/// already; touching counts as crossing. Cells may be unbounded.
CellSide classify(const Primitive& primitive, const PrimitiveData& data, const Aabb& cell);

}  // namespace graycube
