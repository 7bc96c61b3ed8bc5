// Tori. In the primitive's frame the ring has radius 1 about z. A tube thicker than that closes the
// hole: the solid is all that is no farther from the ring than the tube's radius.
#pragma once

#include "csg/roots.hpp"

namespace graycube::csg {

inline Slots torus_slots(double minor) { return {minor, 0, 0, 0, 0, 0}; }
/// The tube's radius in the frame.
inline double torus_minor(const Primitive& p) { return p.v[0]; }

/// Up to two intervals. Membership between roots is evaluated, never counted by parity: a ray
/// tangent to the torus breaks parity.
Spans torus_spans(const Primitive& p, const Ray& ray);
bool torus_contains(const Primitive& p, const Vec3& q);
Vec3 torus_normal(const Primitive& p, const Vec3& q);
CellSide classify_torus(const Primitive& p, const Aabb& cell);
inline bool move_torus(Primitive& p, double by) {
  const bool has_hole = torus_minor(p) < 1;
  p.v[0] += by * stretch(p.to_local, 3);
  return torus_minor(p) > 0 && (torus_minor(p) < 1) == has_hole;
}

}  // namespace graycube::csg
