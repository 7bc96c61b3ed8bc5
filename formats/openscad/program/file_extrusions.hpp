// Extrusions of a drawing that they name themselves, OpenSCAD's old way:
// `linear_extrude(file = "plate.dxf", height = 3)`.
#pragma once

#include <vector>

#include "formats/openscad/language/parser.hpp"

namespace graycube {

/// Gives each extrusion that names a file an import() of that file in place of its children. Layer
/// and origin are the drawing's; `scale` enlarges the drawing, too (OpenSCAD 2021.01,
/// GeometryEvaluator.cc: both extrusions hand it, its x, to the DXF reader).
void import_files_of_extrusions(std::vector<ScadModule>& modules);

}  // namespace graycube
