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
/// round: those that its faces use.
struct ScadSolid {
  CsgNode leaf;
  std::vector<Vec3> corners;
};

/// A convex solid of few faces as half-spaces, any other as a mesh; nothing, with a warning, when
/// its faces enclose none. Corners may be off their places by the precision, a part of their
/// coordinates.
std::optional<ScadSolid> polyhedral_solid(ScadMesh mesh, ScadArguments& arguments,
                                          double precision = kSixDigitPrecision);
/// The precision of what is computed from numbers of so many digits.
double precision_of(std::uint32_t digits);

/// Corners that OpenSCAD's grid makes one.
inline constexpr double kOpenscadGrid = 0.00000095367431640625;

bool is_openscad_primitive(const ScadModule& module);

/// The primitive's solid. Nothing, with a warning, when OpenSCAD would leave it out (size 0, a
/// negative radius, not finite) or it would have too many facets.
/// `digits` are those of the file's numbers.
std::optional<ScadSolid> openscad_primitive(const ScadModule& module, OpenscadReport& report,
                                            bool facets = false,
                                            std::uint32_t digits = kOpenscadDigits);

/// The corners of a polyhedron()'s faces, which may enclose nothing.
std::vector<Vec3> polyhedron_corners(const ScadModule& module, OpenscadReport& report);

/// A sphere, a cylinder or a cone that may stay round.
struct ScadRound {
  bool is_ball = false;
  /// A sphere's radius, or that of the lower end.
  double radius = 0, top_radius = 0;
  /// Heights of the ends.
  double low = 0, high = 0;
  /// Number of sides that OpenSCAD gives it.
  int sides = 0;
};
/// The module as a round solid; nothing, unreported, for any other module.
std::optional<ScadRound> openscad_round(const ScadModule& module);

/// The colour of a color(); components are clamped to at most 1.
ScadColor openscad_color(const ScadModule& module, OpenscadReport& report);

}  // namespace graycube
