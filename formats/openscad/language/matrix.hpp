// The arguments of multmatrix().
#pragma once

#include <cstdint>
#include <optional>

#include "flat/polygon.hpp"
#include "formats/openscad/language/parser.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// The map of a multmatrix(); a rotation, if its entries' `digits` digits can be those of one.
/// Entries that are missing are those of the identity. Of a fourth row only the last entry counts,
/// by which OpenSCAD divides; a warning tells of others. Nothing with an error or, for a singular
/// one, a warning.
std::optional<Affine> openscad_matrix(const ScadModule& module, std::uint32_t digits,
                                      OpenscadReport& report);

/// The same for what only counts by its corners, in a hull(): the map may be singular there.
std::optional<Affine> openscad_matrix_of_corners(const ScadModule& module, std::uint32_t digits,
                                                 OpenscadReport& report);

/// The map of the plane z = 0 that a multmatrix() gives, seen from above; nothing, with a warning,
/// for a singular one.
std::optional<FlatMap> flat_matrix(const ScadModule& module, std::uint32_t digits,
                                   OpenscadReport& report);

}  // namespace graycube
