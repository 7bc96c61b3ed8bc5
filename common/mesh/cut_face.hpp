// Polygons in space cut into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// The side of a solid from which its faces turn counter-clockwise.
enum class FaceSide { kOuter, kInner };

/// Appends the face's triangles, two fewer than its corners, turned as the face is. Concave faces
/// are cut by ears, in the plane of the two axes along which the face's area is largest. Even for a
/// face that is bent or crosses itself, all edges of the triangles cancel but those of the face.
/// `face` holds 3 or more indices into `points`. A bent face is cut as OpenSCAD does; where two
/// ways are equally good, the side from which it turns counter-clockwise decides.
void cut_face(std::span<const Vec3> points, std::span<const std::uint32_t> face, FaceSide side,
              std::vector<Triangle>& triangles);

}  // namespace graycube
