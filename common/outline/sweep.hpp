// An outline in the x-y plane, moved along z between two plane ends.
#pragma once

#include "geometry/ray.hpp"
#include "geometry/spans.hpp"
#include "outline/placed_outline.hpp"

namespace graycube::csg {

// These do for a sweep what the functions of csg/primitive.hpp do for any primitive.
Spans sweep_spans(const PlacedOutline& p, const Ray& ray);
bool sweep_contains(const PlacedOutline& p, const Vec3& point);
Vec3 sweep_normal(const PlacedOutline& p, const Ray& ray, double t);
CellSide classify_sweep(const PlacedOutline& p, const Aabb& cell);

}  // namespace graycube::csg
