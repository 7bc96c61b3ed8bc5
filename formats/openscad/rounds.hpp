// hull() and minkowski() of solids with round parts exact.
#pragma once

#include <variant>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hulls/round_solid.hpp"

namespace graycube {

/// The result for a module: that there is no exact form, that it has no volume, or a solid.
struct NoExactForm {};
struct EmptySolid {};
using ExactSolid = std::variant<NoExactForm, EmptySolid, RoundSolid>;

/// The hull of everything in a module that holds something round. There is no exact form with
/// nothing round in it, with balls and discs together that have no common axis, under maps that
/// make them unlike, and beyond the limits of round_hull.hpp; then nothing is reported.
ExactSolid exact_hull(const ScadModule& module, ScadImport& import);

/// The Minkowski sum, when each operand is a union of convex solids, or all are upright prisms of
/// flat shapes whose sum is exact, perhaps with a ball. Without an exact form nothing is reported.
ExactSolid exact_minkowski(const ScadModule& module, ScadImport& import);

}  // namespace graycube
