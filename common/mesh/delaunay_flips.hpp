// Makes a polygon's triangles those of its constrained Delaunay triangulation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_point.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// Flips diagonals until the circle through each triangle holds no corner beyond its sides (Lawson
/// 1977). `triangles` hold indices of `corners`, counter-clockwise, and cut a polygon with these
/// corners and no others. Of four corners nearly on a circle the diagonal stays.
void flip_to_delaunay(std::span<const FacePoint> corners, std::span<Triangle> triangles);

}  // namespace graycube
