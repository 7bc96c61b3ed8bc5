// Convex hulls of points, by Qhull, whose only home is convex_hull.cpp.
#pragma once

#include <vector>

#include "formats/openscad/hulls/mesh.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// The triangles of the convex hull; no faces when the points lie in a plane, or one lies beyond
/// kMaxOpenscadCoordinate.
ScadMesh convex_hull(const std::vector<Vec3>& points);

}  // namespace graycube
