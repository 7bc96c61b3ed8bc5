// Paraboloids, hyperboloids and cylinders over parabolas and hyperbolas, cut by planes of the
// world: in the primitive's frame x² + v[0] y² + v[1] z² + v[2] z + v[3] ≤ 0, and within
// planes[first_plane, + plane_count).
#pragma once

#include "csg/half_space.hpp"

namespace graycube::csg {

inline Slots quadric_slots(const std::array<double, 4>& q) {
  return {q[0], q[1], q[2], q[3], 0, 0};
}

/// The coefficients of y², z², z and 1.
inline std::array<double, 4> quadric_coefficients(const Primitive& p) {
  return {p.v[0], p.v[1], p.v[2], p.v[3]};
}

inline double quadric_value(const Primitive& p, const Vec3& l) {
  return l.x * l.x + p.v[0] * l.y * l.y + (p.v[1] * l.z + p.v[2]) * l.z + p.v[3];
}

/// A quadric that is a round cylinder in its frame, whose side is solved as a cylinder's is, by the
/// same expressions.
inline bool is_tube(const Primitive& p) {
  return p.v[0] == 1 && p.v[1] == 0 && p.v[2] == 0 && p.v[3] == -1;
}

Spans quadric_spans(const Primitive& p, std::span<const Plane> faces, const Ray& ray);
bool quadric_contains(const Primitive& p, std::span<const Plane> faces, const Vec3& q);
Vec3 quadric_normal(const Primitive& p, std::span<const Plane> faces, const Ray& ray, double t);
CellSide classify_quadric(const Primitive& p, std::span<const Plane> faces, const Aabb& cell);

}  // namespace graycube::csg
