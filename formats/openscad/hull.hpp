// The corners of which a hull() of solids is the convex hull.
#pragma once

#include <vector>

#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/program/import.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// The corners of OpenSCAD's facets of everything in a module; false when it holds a module whose
/// corners aren't known without evaluating it, such as a difference.
bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners);

}  // namespace graycube
