// Parts of a model as OpenSCAD evaluates them, with what there is to tell of them. What can't be
// had is left out with a warning.
#pragma once

#include <optional>

#include "flat/polygon.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/program/import.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// The mesh of a solid module, which need not be closed; meshes in STL and OFF files are read here,
/// with all their digits. Nothing when the module is nothing, is left out, or is yet to be asked
/// for. Without a program there is an error.
std::optional<PolygonMesh> solid_by_program(const ScadModule& module, ScadImport& import);

/// The same for the figure of a flat module.
std::optional<FlatLoops> flat_by_program(const ScadModule& module, ScadImport& import);

}  // namespace graycube
