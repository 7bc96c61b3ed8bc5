// Minkowski sums of upright prisms, whose figures need not be convex: the figures' sum, extruded.
#pragma once

#include <optional>

#include "formats/openscad/flat/shape.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Most prisms in one operand, and in the sum.
inline constexpr std::size_t kMaxPrismSums = 64;

/// The sum of the module's operands if each is a union of upright prisms. One may be a ball if the
/// others' figures add up to polygons, and to disks wider than the ball. Nothing when it isn't
/// exact, or empty.
std::optional<CsgNode> exact_prism_sum(const ScadModule& module, ScadImport& import);

/// The same with OpenSCAD's sides for what is round, without balls.
std::optional<CsgNode> faceted_prism_sum(const ScadModule& module, ScadImport& import);

}  // namespace graycube
