// The arguments of linear_extrude() and rotate_extrude().
#pragma once

#include <optional>

#include "formats/openscad/language/import.hpp"
#include "formats/openscad/sweep_mesh.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// Nothing if the solid is empty, or the arguments wrong, which is reported.
std::optional<LinearSweep> linear_sweep(const ScadModule& module, ScadImport& import);
/// `loops`: the figure that is turned.
std::optional<TurnSweep> turn_sweep(const ScadModule& module, ScadImport& import,
                                    const FlatLoops& loops);

/// What the sweep's lean does to the solid that stands upright.
Affine leaning(const LinearSweep& sweep);

}  // namespace graycube
