// Texels of many directions at once.
#pragma once

#include <cstdint>
#include <span>

namespace graycube {

/// The spans of find_opposite_texels must reach to a multiple of this many elements.
inline constexpr std::size_t kTexelLanes = 8;

/// cube_texel (cube_map.hpp) of the directions opposite to (x, y, z)[i], on faces of side × side
/// texels, for each i < count. A direction that is no number gets some texel.
void find_opposite_texels(std::span<const double> x, std::span<const double> y,
                          std::span<const double> z, std::size_t count, std::uint32_t side,
                          std::span<std::uint32_t> texels);

}  // namespace graycube
