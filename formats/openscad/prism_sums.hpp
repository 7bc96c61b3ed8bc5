// Minkowski sums of upright prisms, whose figures need not be convex: their figures' sum, extruded.
#pragma once

#include <optional>

#include "formats/openscad/flat/shape.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Prisms in one operand, and in the sum, at most.
inline constexpr std::size_t kMaxPrismSums = 64;

/// The sum of the module's operands when each is a union of upright prisms, but for one that may be
/// a ball where the others' figures add up to polygons, and to disks wider than the ball. Nothing
/// when it isn't exact, or empty.
std::optional<CsgNode> exact_prism_sum(const ScadModule& module, ScadImport& import);

}  // namespace graycube
