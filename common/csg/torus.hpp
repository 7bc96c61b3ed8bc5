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

/// Whether a point found on a figure that was turned about z lies on the axis, to within rounding:
/// a small share of its distance from there changes the figure's equation by less than it is `off`.
/// `slope` is the equation's, per distance from the axis. Figures that reach across the axis have
/// tips there.
inline bool is_on_axis(double distance, double off, double slope) {
  constexpr double kNear = 1e-6, kShare = 1.0 / 64;
  if (distance > kNear) return false;
  return !(std::fabs(off) < kShare * std::fabs(slope) * distance);
}
/// The normal of a tip, between those of the sides around it; `up` is their common part along z.
inline Vec3 normal_on_axis(const Primitive& p, double up) {
  return normalized(p.to_local.transposed_vector({0, 0, up != 0 ? up : 1}));
}

inline bool move_torus(Primitive& p, double by) {
  const bool has_hole = torus_minor(p) < 1;
  p.v[0] += by * stretch(p.to_local, 3);
  return torus_minor(p) > 0 && (torus_minor(p) < 1) == has_hole;
}

}  // namespace graycube::csg
