// An outline in the half plane of distances r ≥ 0 from the z axis (x) and heights z (y), turned
// about that axis.
#pragma once

#include "geometry/ray.hpp"
#include "geometry/spans.hpp"
#include "outline/placed_outline.hpp"

namespace graycube::csg {

// These do for a lathe what the functions of csg/primitive.hpp do for any primitive.
Spans lathe_spans(const PlacedOutline& p, const Ray& ray);
bool lathe_contains(const PlacedOutline& p, const Vec3& point);
Vec3 lathe_normal(const PlacedOutline& p, const Ray& ray, double t);
CellSide classify_lathe(const PlacedOutline& p, const Aabb& cell);

}  // namespace graycube::csg
