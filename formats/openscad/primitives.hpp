// cube(), sphere(), cylinder() and polyhedron(), and the arguments of color().
#pragma once

#include <optional>
#include <vector>

#include "formats/openscad/hulls/mesh.hpp"
#include "formats/openscad/language/arguments.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/view/palette.hpp"

namespace graycube {

/// A leaf in its own coordinates, its material still to be set; and its corners, unless it is
/// round.
struct ScadSolid {
  CsgNode leaf;
  std::vector<Vec3> corners;
};

/// A convex solid of few faces as half-spaces, any other as a mesh; nothing, reported, when its
/// faces enclose none.
std::optional<ScadSolid> polyhedral_solid(ScadMesh mesh, ScadArguments& arguments);

bool is_openscad_primitive(const ScadModule& module);

/// The primitive's solid. Nothing, with a warning, when OpenSCAD would leave it out (size 0, a
/// negative radius, not finite); nothing, with an error, when the arguments make no sense here.
std::optional<ScadSolid> openscad_primitive(const ScadModule& module, OpenscadReport& report,
                                            bool facets = false);

/// A sphere, or a cylinder as wide at both ends, that may stay round.
struct ScadRound {
  bool is_ball = false;
  double radius = 0;
  /// Number of sides that OpenSCAD gives it.
  int sides = 0;
};
/// The module as a round solid; nothing, unreported, for any other module.
std::optional<ScadRound> openscad_round(const ScadModule& module);

/// The colour of a color(); components are clamped to at most 1. Nothing after an error.
std::optional<ScadColor> openscad_color(const ScadModule& module, OpenscadReport& report);

}  // namespace graycube
