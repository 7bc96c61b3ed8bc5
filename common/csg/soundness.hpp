// The range in which solids can be computed. Areas of boxes within it stay in the range of floats,
// in which hierarchies of boxes are made, and fourth powers of local coordinates in that of
// doubles.
#pragma once

#include <span>

#include "csg/primitive.hpp"

namespace graycube {

/// The largest coordinate that a solid, an eye or a light may have.
inline constexpr double kMaxCoordinate = 1e18;
/// The least radius of a sphere, largest side of a mesh or polyhedron, and length of an axis of any
/// solid that is computed in its own frame.
inline constexpr double kLeastSize = 1e-18;

/// Whether no finite coordinate of the box is beyond kMaxCoordinate; an infinite one is none.
bool is_within_range(const Aabb& box);
/// Whether the point is finite and no coordinate beyond kMaxCoordinate.
bool is_within_range(const Vec3& point);

/// Why a primitive that was built can't be computed, to follow "the sphere "; null if it can be.
/// `planes` are those of the primitive's model. Builders leave NaN where a map has no inverse.
const char* why_unsound(const Primitive& primitive, std::span<const Plane> planes);

}  // namespace graycube
