// The holes of an open mesh, and filling those that are flat.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// The corners around a hole, each once, turned as a face that closes it is.
using Hole = std::vector<std::uint32_t>;

/// The cycles of edges that are used less often one way than the other, an edge as many times as
/// uses are missing. A face for each of them closes the mesh. Points are below 2³¹.
std::vector<Hole> holes_of(std::span<const Triangle> triangles, std::size_t points);

/// Whether the corners are within `tolerance` of a plane, or of a line: then the hole is a face
/// missing, or an edge to which other corners were added on one side only.
bool is_flat(const Hole& hole, std::span<const Vec3> points, double tolerance);

}  // namespace graycube
