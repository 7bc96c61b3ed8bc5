// The corners of which a hull() of solids is the convex hull, and such hulls as solids.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "formats/openscad/hulls/round_solid.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/program/import.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// The corners of OpenSCAD's facets of everything in a module; false when it holds a module whose
/// corners aren't known without evaluating it, such as a difference.
bool corners_of(const ScadModule& module, const Affine& map, ScadImport& import,
                std::vector<Vec3>& corners);

/// The convex hull of corners, which stands for the module. Nothing, which is reported, if it has
/// no volume or reaches too far.
std::optional<ScadSolid> solid_hull(const ScadModule& module, const std::vector<Vec3>& corners,
                                    ScadImport& import);

/// A minkowski() in OpenSCAD's facets. Nothing, unreported, unless all operands are unions of
/// convex solids whose corners are known, and the sums aren't too many.
std::optional<RoundSolid> faceted_sum(const ScadModule& module, ScadImport& import);

/// Most corners of operands that are added up for one module.
inline constexpr std::size_t kMaxFacetedSum = std::size_t{1} << 20;

}  // namespace graycube
