// hull() of solids, by Qhull, whose only home is openscad_hull.cpp.
#pragma once

#include <optional>
#include <vector>

#include "scene/openscad_flat.hpp"
#include "scene/openscad_primitives.hpp"

namespace graycube {

/// The triangles of the convex hull; no faces when the points lie in a plane, or one lies beyond
/// kMaxOpenscadCoordinate.
ScadMesh convex_hull(const std::vector<Vec3>& points);

/// The corners of OpenSCAD's facets of everything in a module; false when it holds something whose
/// corners aren't known without evaluating it, a difference for one.
bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners);

}  // namespace graycube
