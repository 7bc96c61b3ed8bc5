// Solids swept by polygons, as CSG of exact primitives.
#pragma once

#include <optional>

#include "flat/polygon.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// The polygon × [low, high] along z: convex polyhedra and boxes, united and subtracted. Nothing
/// for an empty polygon, or one whose outline crosses itself in a way that can't be resolved.
std::optional<CsgNode> prism_of(const FlatLoops& loops, double low, double high);
std::optional<CsgNode> prism_of(const PrismShape& shape);

/// The loops of a prism.
FlatLoops loops_of(const PrismShape& shape);
/// A prism of these loops.
PrismShape prism_shape(const FlatLoops& loops, double low, double high);

/// The part x ≥ 0 of the polygon turned about the z axis, x being the distance from it and y the
/// height: cones and cylinders, united and subtracted. Nothing when prism_of() gives nothing.
std::optional<CsgNode> turned(const FlatLoops& loops);

}  // namespace graycube
