// How often the sides of polygons cross one another, on which the time of all operations on them
// depends.
#pragma once

#include <cstddef>
#include <span>

#include "flat/polygon.hpp"

namespace graycube {

/// Whether the operations of polygon.hpp end soon: at most so many pairs of sides cross, so many
/// have boxes that overlap, and Clipper's line passes so many sides on all its stops together.
/// (Clipper's time grows faster than the crossings: 70 000 took 7 s.)
inline constexpr std::size_t kMaxFlatCrossings = std::size_t{1} << 15;
inline constexpr std::size_t kMaxFlatOverlaps = std::size_t{1} << 22;
inline constexpr std::size_t kMaxFlatPasses = std::size_t{1} << 29;
bool crossings_are_few(std::span<const FlatLoops> operands);
/// The same with at most `left` crossings, which are then taken off it.
bool crossings_are_few(std::span<const FlatLoops> operands, std::size_t& left);

}  // namespace graycube
