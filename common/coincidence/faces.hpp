// The plane faces of primitives, whatever the kind: reading and replacing them.
#pragma once

#include <cstdint>

#include "coincidence/exactness.hpp"
#include "csg/box.hpp"
#include "csg/cylinder.hpp"
#include "csg/half_space.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// A plane of a primitive; its normal is outward and unit. `slot` is its number among the
/// primitive's own planes.
struct Face {
  Plane plane;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
};

/// The number of a primitive's plane faces; 0 for a mesh, whose faces are found by
/// coincidence/mesh_faces.hpp.
inline std::uint32_t face_count(const Primitive& p) {
  switch (p.kind) {
    case PrimitiveKind::kBox:
    case PrimitiveKind::kParallelepiped: return 6;
    case PrimitiveKind::kCylinder:
    case PrimitiveKind::kCone:
    case PrimitiveKind::kSweep:
    case PrimitiveKind::kEllipticCone: return 2;
    case PrimitiveKind::kHalfSpace: return 1;
    case PrimitiveKind::kPolyhedron:
    case PrimitiveKind::kQuadric: return p.plane_count;
    case PrimitiveKind::kSphere:
    case PrimitiveKind::kEllipsoid:
    case PrimitiveKind::kTorus:
    case PrimitiveKind::kEllipticTorus:
    case PrimitiveKind::kLathe:
    case PrimitiveKind::kMesh: break;
  }
  return 0;
}
/// Whether faces come in pairs that share a normal, which the first looks against: the faces of
/// boxes and parallelepipeds, and caps.
inline bool has_opposite_faces(const Primitive& p) {
  return p.kind != PrimitiveKind::kHalfSpace && p.plane_count == 0;
}
Face face_of(const Model& model, std::uint32_t primitive, std::uint32_t slot);
/// The normal of a single face, or of the second face of a pair.
inline Vec3 heading_of(const Model& model, const Primitive& p, std::uint32_t slot) {
  switch (p.kind) {
    case PrimitiveKind::kBox: {
      Vec3 axis;
      axis[static_cast<int>(slot / 2)] = 1;
      return axis;
    }
    case PrimitiveKind::kParallelepiped: return p.to_local.row(static_cast<int>(slot / 2));
    case PrimitiveKind::kPolyhedron:
    case PrimitiveKind::kQuadric: return model.planes[p.first_plane + slot].normal;
    case PrimitiveKind::kHalfSpace: return half_space_plane(p).normal;
    case PrimitiveKind::kCylinder:
    case PrimitiveKind::kCone:
    case PrimitiveKind::kSweep:
    case PrimitiveKind::kEllipticCone: return cap_normal(p);
    default: return {};
  }
}
/// The offset of a face along the normal that heading_of() gives.
inline double offset_of(const Model& model, const Primitive& p, std::uint32_t slot) {
  switch (p.kind) {
    case PrimitiveKind::kBox:
    case PrimitiveKind::kParallelepiped: return box_side(p.v, slot % 2, slot / 2);
    case PrimitiveKind::kPolyhedron:
    case PrimitiveKind::kQuadric: return model.planes[p.first_plane + slot].offset;
    case PrimitiveKind::kHalfSpace: return half_space_plane(p).offset;
    default: return slot == 0 ? lower_cap(p) : upper_cap(p);
  }
}
/// Replaces a face's plane. Both faces of a pair share the normal: give both the same.
void set_face(Model& model, const Face& face);

/// A point of the face's plane in the middle of the primitive; of an unbounded one, the point
/// nearest the origin.
Vec3 anchor_of(const Primitive& p, const Plane& plane);

/// How far off the face's normal may be, in radians. Planes of polyhedra and quadrics were computed
/// from corners by somebody: a small solid far away has directions worse than its numbers.
double direction_tolerance(const Primitive& p, const Vec3& normal, const Exactness& exactness);

/// Makes a parallelepiped whose faces have come to lie across the world's axes a box, and gives the
/// primitive bounds around its faces, which have moved by at most `moved`.
void settle_faces(Model& model, std::uint32_t primitive, double moved);

}  // namespace graycube::csg
