// Makes points one that differ by rounding only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec.hpp"

namespace graycube {

/// For each point the index of the first within `tolerance` of it, along every axis, that is not
/// itself another's: points of a chain don't all become one. All coordinates must be finite.
std::vector<std::uint32_t> first_within(std::span<const Vec3> points, double tolerance);

}  // namespace graycube
