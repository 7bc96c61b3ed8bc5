// Ellipses turned about an axis. In the primitive's frame, with ρ² = x² + y², v[0] (ρ − 1)² +
// 2 v[1] (ρ − 1) z + v[2] z² ≤ 1; the ellipse reaches v[3] outwards and v[4] along the axis. One
// that reaches across the axis leaves no hole, and its part beyond the axis is turned like the
// rest.
#pragma once

#include "csg/roots.hpp"

namespace graycube::csg {

/// Slots from the ellipse's three coefficients and its reach outwards and along the axis.
inline Slots elliptic_torus_slots(const Vec3& ellipse, double outwards, double along) {
  return {ellipse.x, ellipse.y, ellipse.z, outwards, along, 0};
}

/// The coefficient of (ρ − 1)², half that of (ρ − 1) z, and that of z².
inline Vec3 ellipse_of(const Primitive& p) { return {p.v[0], p.v[1], p.v[2]}; }

Spans elliptic_torus_spans(const Primitive& p, const Ray& ray);
bool elliptic_torus_contains(const Primitive& p, const Vec3& q);
Vec3 elliptic_torus_normal(const Primitive& p, const Vec3& q);
CellSide classify_elliptic_torus(const Primitive& p, const Aabb& cell);

}  // namespace graycube::csg
