// The corners that hull() of solids goes by.
#pragma once

#include <vector>

#include "formats/openscad/language/import.hpp"
#include "formats/openscad/language/parser.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// The corners of OpenSCAD's facets of everything in a module; false when it holds something whose
/// corners aren't known without evaluating it, a difference for one.
bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners);

}  // namespace graycube
