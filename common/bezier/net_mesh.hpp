// Solids bounded by bicubic Bézier patches (J. Clark 1976), as closed triangle meshes.
//
// Crossings of rays with the patches themselves, each found to a bound of its own, need not agree
// where patches meet: a ray along a seam may cross both, or neither, and what is inside would
// depend on rounding. So patches become triangles that share their corners along every seam. They
// are closed to the bit, and no further from the patches than a tolerance.
#pragma once

#include <variant>

#include "bezier/net.hpp"
#include "mesh/close_mesh.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// The mesh of a net, with its normals outward. Indices must be in range. Faults: those of
/// division_of() and closed_mesh().
std::variant<TriangleMesh, MeshFault> mesh_of(const BezierNet& net, double tolerance);

}  // namespace graycube
