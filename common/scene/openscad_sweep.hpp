// linear_extrude() and rotate_extrude(): exact where OpenSCAD's solid is the sweep itself, meshes of OpenSCAD's own
// facets where it isn't (twist, scale), or where facets are asked for.
#pragma once

#include <optional>
#include <vector>

#include "scene/openscad_flat.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// The solid of one of the two modules in its own coordinates; nothing where it is empty or wrong, which is reported.
std::optional<CsgNode> openscad_sweep(const ScadModule& module, ScadImport& import);

/// The figure × [low, high] along z.
std::optional<CsgNode> extruded(const FlatShape& shape, double low, double high, ScadImport& import, int line);

/// The corners of OpenSCAD's mesh of the solid. False when it is empty or wrong, which is reported.
bool sweep_corners(const ScadModule& module, ScadImport& import, std::vector<Vec3>& corners);

/// A closed mesh as a leaf; nothing when it is empty, or, with an error, when it isn't closed.
std::optional<CsgNode> mesh_leaf(const PolygonMesh& mesh, const ScadModule& module, OpenscadReport& report);

}  // namespace graycube
