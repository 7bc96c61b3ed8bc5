// Grows or shrinks polygons with exact arcs: the result is a polygon and disks at its corners.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// A grown figure is the polygon and disks about the centers; a shrunk one is the polygon less
/// these disks. Their radius is the |distance|.
struct RoundOffset {
  FlatLoops polygon;
  FlatLoop centers;
};

/// The most corners of the polygon, and so disks: an outline with more is a curve made of facets
/// rather than one with corners.
inline constexpr std::size_t kMaxRoundCorners = 256;

/// Everything within `distance` of the polygon; if it is negative, the polygon less everything
/// within |distance| of its outside. Nothing beyond kMaxRoundCorners, or when the areas swept by
/// moving sides cross too often.
std::optional<RoundOffset> round_offset(const FlatLoops& loops, double distance);

/// The result with corners that Clipper rounded to its grid moved to the crossing of the lines of
/// their sides: lines of the polygon's sides, or the same moved outwards by `distance`. With more
/// pairs of corners of the two than this, which take 0.3 s, all corners stay.
inline constexpr std::size_t kMaxLinePairs = std::size_t{1} << 26;
FlatLoops on_lines(FlatLoops result, const FlatLoops& polygon, double distance);

}  // namespace graycube
