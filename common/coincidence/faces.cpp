#include "coincidence/faces.hpp"

#include <algorithm>
#include <cmath>

#include "csg/box.hpp"
#include "csg/cylinder.hpp"
#include "csg/half_space.hpp"

namespace graycube::csg {
namespace {

bool is_upper(std::uint32_t slot) { return slot % 2 == 1; }
int axis_of(std::uint32_t slot) { return static_cast<int>(slot / 2); }

bool is_world_axis(const Vec3& n) {
  return (std::fabs(n.x) == 1) + (std::fabs(n.y) == 1) + (std::fabs(n.z) == 1) == 1 &&
         (n.x == 0) + (n.y == 0) + (n.z == 0) == 2;
}

void set_row(Affine& map, int row, const Vec3& v) {
  map.m[static_cast<std::size_t>(row)] = {v.x + 0.0, v.y + 0.0, v.z + 0.0, 0};
}

/// Makes a parallelepiped with normals along the world's axes a box.
void become_box(Primitive& p) {
  Vec3 lo, hi;
  for (int a = 0; a < 3; ++a) {
    const Vec3 n = p.to_local.row(a);
    for (int w = 0; w < 3; ++w) {
      if (n[w] == 0) continue;
      const auto i = static_cast<std::size_t>(a);
      const double lower = box_side(p.v, 0, i), upper = box_side(p.v, 1, i);
      lo[w] = (n[w] > 0 ? lower : -upper) + 0.0;
      hi[w] = (n[w] > 0 ? upper : -lower) + 0.0;
    }
  }
  p.kind = PrimitiveKind::kBox;
  p.to_local = {};
  p.v = {lo.x, lo.y, lo.z, hi.x, hi.y, hi.z};
}

}  // namespace

Face face_of(const Model& model, std::uint32_t primitive, std::uint32_t slot) {
  const Primitive& p = model.primitives[primitive];
  const Plane along{heading_of(model, p, slot), offset_of(model, p, slot)};
  const bool is_backward = has_opposite_faces(p) && !is_upper(slot);
  return {is_backward ? Plane{-along.normal, -along.offset} : along, primitive, slot};
}

void set_face(Model& model, const Face& face) {
  Primitive& p = model.primitives[face.primitive];
  const auto axis = static_cast<std::size_t>(axis_of(face.slot));
  const Vec3 normal = is_upper(face.slot) ? face.plane.normal : -face.plane.normal;
  const double offset = (is_upper(face.slot) ? face.plane.offset : -face.plane.offset) + 0.0;
  switch (p.kind) {
    case PrimitiveKind::kBox: set_box_side(p, is_upper(face.slot), axis, offset); return;
    case PrimitiveKind::kParallelepiped:
      set_row(p.to_local, axis_of(face.slot), normal);
      set_box_side(p, is_upper(face.slot), axis, offset);
      return;
    case PrimitiveKind::kCylinder:
    case PrimitiveKind::kCone:
    case PrimitiveKind::kSweep:
    case PrimitiveKind::kEllipticCone:
      set_caps(p, normal + Vec3{}, is_upper(face.slot) ? lower_cap(p) : offset,
               is_upper(face.slot) ? offset : upper_cap(p));
      return;
    case PrimitiveKind::kHalfSpace:
      p.v = half_space_slots({face.plane.normal + Vec3{}, face.plane.offset + 0.0});
      return;
    default: {
      const Vec3& n = face.plane.normal;
      model.planes[p.first_plane + face.slot] = {{n.x + 0.0, n.y + 0.0, n.z + 0.0},
                                                 face.plane.offset + 0.0};
    }
  }
}

Vec3 anchor_of(const Primitive& p, const Plane& plane) {
  if (!p.bounds.is_finite()) return plane.offset * plane.normal;
  return nearest_on(plane, p.bounds.center());
}

double direction_tolerance(const Primitive& p, const Vec3& normal, const Exactness& exactness) {
  const bool has_planes = p.kind == PrimitiveKind::kPolyhedron || p.kind == PrimitiveKind::kQuadric;
  if (!has_planes || !p.bounds.is_finite()) return exactness.direction;
  const Vec3 n{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  const int along = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
  const Vec3 size = p.bounds.hi - p.bounds.lo;
  const double across = std::min(size[(along + 1) % 3], size[(along + 2) % 3]);
  return exactness.direction + (across > 0 ? std::min(exactness.distance() / across, 1.0) : 0.0);
}

void settle_faces(Model& model, std::uint32_t primitive, double moved) {
  Primitive& p = model.primitives[primitive];
  if (p.kind == PrimitiveKind::kParallelepiped && is_world_axis(p.to_local.row(0)) &&
      is_world_axis(p.to_local.row(1)) && is_world_axis(p.to_local.row(2))) {
    become_box(p);
  }
  if (p.kind == PrimitiveKind::kBox) {
    p.bounds = {box_lo(p), box_hi(p)};
  } else if (p.kind == PrimitiveKind::kPolyhedron) {
    p.bounds = polyhedron_bounds(faces_of(p, model.planes));
  } else if (p.kind == PrimitiveKind::kHalfSpace) {
    p.bounds = half_space_bounds(half_space_plane(p));
  } else {
    // If a face meets others at a small angle, its edges move farther than the face does.
    constexpr double kFarther = 8;
    p.bounds = p.bounds.grown(kFarther * moved);
  }
}

}  // namespace graycube::csg
