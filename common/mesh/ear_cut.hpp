// Polygons of the plane cut into triangles by ears.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_point.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// Corners that are looked at while one polygon is cut: 2 s. Beyond it, and where no ear is left,
/// the rest is cut by whatever corners come next.
inline constexpr std::uint64_t kMaxEarTests = std::uint64_t{1} << 30;

/// Appends the triangles of a polygon of 3 or more corners, two fewer than these, turned as it is,
/// which should be counter-clockwise. Cuts ears off (Meisters 1975), going on past the neighbour of
/// each, so that no fan of slivers grows about one corner. A grid tells which corners are near an
/// ear: the time grows about as n^1.5, at worst as n². Of a polygon that crosses itself, too, all
/// sides of the triangles cancel but those of the polygon.
void cut_ears(std::span<const FacePoint> corners, std::vector<Triangle>& triangles);

}  // namespace graycube
