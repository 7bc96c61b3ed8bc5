// Cones between two ellipses of different shapes: capped like cones, with axes that shrink by
// different shares. In the primitive's frame the solid is x² / (1 − z)² + y² / (1 − k z)² ≤ 1
// between its caps; k, the second slope, lies in [−1, 1). It need not be convex.
#pragma once

#include "csg/cylinder.hpp"

namespace graycube::csg {

inline double second_slope(const Primitive& p) { return p.v[5]; }
inline void set_second_slope(Primitive& p, double k) { p.v[5] = k; }

Spans elliptic_cone_spans(const Primitive& p, const Ray& ray);
bool elliptic_cone_contains(const Primitive& p, const Vec3& q);
Vec3 elliptic_cone_normal(const Primitive& p, const Ray& ray, double t);
CellSide classify_elliptic_cone(const Primitive& p, const Aabb& cell);

}  // namespace graycube::csg
