// A polygon that every upright line meets at most twice, cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/face_point.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// Appends the triangles of a polygon given counter-clockwise: indices of its corners, each
/// triangle counter-clockwise. False, and nothing is appended, if some upright line meets the
/// polygon more than twice or two corners are one.
///
/// It is swept from right to left, and a triangle is cut off as soon as its corners are passed
/// (Garey, Johnson, Preparata, Tarjan 1978). So does libtess2, by which OpenSCAD cuts faces: where
/// a face may be cut in two ways that are equally good, they agree.
bool cut_monotone(std::span<const FacePoint> corners, std::vector<Triangle>& triangles);

}  // namespace graycube
