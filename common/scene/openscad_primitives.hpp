// cube(), sphere(), cylinder() and polyhedron(), and the arguments of multmatrix() and color().
#pragma once

#include <optional>
#include <vector>

#include "geometry/affine.hpp"
#include "scene/openscad_palette.hpp"
#include "scene/openscad_parser.hpp"

namespace graycube {

/// A leaf in its own coordinates, material still to be set; the corners, when it is a polyhedron.
struct ScadSolid {
  CsgNode leaf;
  std::vector<Vec3> corners;
};

bool is_openscad_primitive(const ScadModule& module);

/// The primitive's solid. Nothing, with a warning, when OpenSCAD would leave it out (size 0, a
/// negative radius, not finite); nothing, with an error, when the arguments make no sense here.
std::optional<ScadSolid> openscad_primitive(const ScadModule& module, OpenscadReport& report);

/// The map of a multmatrix(); entries that are missing are those of the identity, and a fourth row
/// [0, 0, 0, w] divides by w. Nothing with an error or, for a singular one, a warning.
std::optional<Affine> openscad_matrix(const ScadModule& module, OpenscadReport& report);

/// The colour of a color(); components are clamped to at most 1. Nothing with an error.
std::optional<ScadColor> openscad_color(const ScadModule& module, OpenscadReport& report);

}  // namespace graycube
