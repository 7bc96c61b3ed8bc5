// Offsets in bounded time, also where they reach far: moved sides of a figure with n corners can
// cross one another n² times.
#pragma once

#include <cstddef>
#include <optional>

#include "flat/polygon.hpp"

namespace graycube {

/// The most crossings of moved sides that are left to one operation of Clipper's: 0.2 s.
inline constexpr std::size_t kMaxCrossingsAtOnce = std::size_t{1} << 13;
/// The most corners of the areas that all sides sweep, with the facets of round joins.
inline constexpr std::size_t kMaxSweptCorners = std::size_t{1} << 20;
/// The most crossings of sides in all unions of such areas together.
inline constexpr std::size_t kMaxSweptCrossings = std::size_t{1} << 20;

/// offset() of outlines that don't cross, counter-clockwise, with holes clockwise; nothing beyond
/// these limits and those of crossings_are_few(). Where more sides cross than kMaxCrossingsAtOnce,
/// it is swept_offset().
std::optional<FlatLoops> bounded_offset(const FlatLoops& loops, double distance, FlatJoin join,
                                        double arc_tolerance);

/// The same figure, up to rounding, in steps: it grows by the areas that its sides sweep on their
/// way outwards, with joins at convex corners (or loses those that they sweep inwards). Sides that
/// follow one another are united first, then what is next to each other of that, and so on. What
/// other sides cover is gone before it can cross much.
std::optional<FlatLoops> swept_offset(const FlatLoops& loops, double distance, FlatJoin join,
                                      double arc_tolerance);

}  // namespace graycube
