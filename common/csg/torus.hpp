#pragma once

#include "csg/roots.hpp"

namespace graycube::csg {

inline double torus_minor(const Primitive& p) { return p.v[0]; }

/// Up to two intervals. Membership between roots is evaluated, never counted by parity: a ray
/// tangent to the torus breaks parity.
Spans torus_spans(const Primitive& p, const Ray& ray);
bool torus_contains(const Primitive& p, const Vec3& q);
Vec3 torus_normal(const Primitive& p, const Vec3& q);
CellSide classify_torus(const Primitive& p, const Aabb& cell);

}  // namespace graycube::csg
