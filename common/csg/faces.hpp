// The plane faces of primitives, whatever the kind: reading and replacing them.
#pragma once

#include <cstdint>

#include "csg/exactness.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// A plane of a primitive, its normal outward and unit. Numbers of `slot` count the primitive's own planes.
struct Face {
  Plane plane;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
};

/// How many plane faces a primitive has; those of meshes aren't counted (csg/mesh_faces.hpp).
std::uint32_t face_count(const Primitive& p);
/// Faces come in pairs with one normal, backwards on the first: boxes' and parallelepipeds', and caps.
bool has_opposite_faces(const Primitive& p);
Face face_of(const Model& model, std::uint32_t primitive, std::uint32_t slot);
/// Both faces of a pair share the normal: give them the same.
void set_face(Model& model, const Face& face);

/// A point of the face's plane in the middle of the primitive; of an unbounded one, the point nearest the origin.
Vec3 anchor_of(const Primitive& p, const Plane& plane);

/// How far off the face's normal may be, in radians. Planes of polyhedra and quadrics were computed from corners by somebody:
/// a small solid far away has directions worse than its numbers.
double direction_tolerance(const Primitive& p, const Plane& plane, const Exactness& exactness);

/// Makes a parallelepiped whose faces have come to lie across the world's axes a box, and gives the primitive bounds around
/// its faces, which have moved by at most `moved`.
void settle_faces(Model& model, std::uint32_t primitive, double moved);

}  // namespace graycube::csg
