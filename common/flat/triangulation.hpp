// Figures of the plane, with holes, cut into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// Corners are numbered through all loops, one loop after the other.
using FlatTriangle = std::array<std::uint32_t, 3>;

/// The triangles of the figure, counter-clockwise, with the loops' corners and no others; every
/// side of a loop is a side of one triangle. Loops may touch at corners. Nothing where sides cross,
/// or a corner lies on a side between its ends. The time grows little faster than the corners.
std::optional<std::vector<FlatTriangle>> triangles_of(std::span<const FlatLoop> loops);

}  // namespace graycube
