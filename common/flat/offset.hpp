// Polygons grown or shrunk with exact arcs: a polygon, and the disks that round its corners.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// Grown: the polygon and the disks. Shrunk: the polygon less the disks. Their radius is the
/// distance.
struct RoundOffset {
  FlatLoops polygon;
  FlatLoop centers;
};

/// Corners of the polygon at most, and so disks: more are no outline with corners but a curve made
/// of facets.
inline constexpr std::size_t kMaxRoundCorners = 256;

/// Everything within |distance| of the polygon; for a negative one, of what is not the polygon,
/// taken away from it. Nothing beyond the limit, or where the sides moved by the distance cross too
/// often.
std::optional<RoundOffset> round_offset(const FlatLoops& loops, double distance);

/// Corners that Clipper rounded to its grid, moved to where the lines cross that their sides lie
/// on: those of the polygon, and the same moved outwards by `distance`.
FlatLoops on_lines(FlatLoops result, const FlatLoops& polygon, double distance);

}  // namespace graycube
