// Polygons with rounded corners: in offsets one after another their sides move and the corners'
// radii add up, as long as no side vanishes or meets another.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"
#include "flat/rounds.hpp"

namespace graycube {

struct RoundedLoop {
  /// The points where the sides would meet without rounding; the inside is on the left.
  FlatLoop corners;
  /// The radius of the arc that touches both sides at each corner; 0 for a sharp corner.
  std::vector<double> radii;
};
using RoundedPolygon = std::vector<RoundedLoop>;

/// The polygon without rounding. Outlines must be counter-clockwise and holes clockwise, as Clipper
/// leaves them; empty beyond kMaxRoundedCorners.
RoundedPolygon sharp_polygon(const FlatLoops& loops);

/// The polygon with sides moved outwards by the distance, inwards if it is negative. Sharp corners
/// become round where the sides part, if `rounds_corners`, else they stay sharp. Nothing when a
/// side vanishes or an arc doesn't fit.
std::optional<RoundedPolygon> moved(const RoundedPolygon& polygon, double distance,
                                    bool rounds_corners);

/// The polygon and the disks of `added`, less the disks of `removed`.
struct RoundedParts {
  FlatLoops polygon;
  std::vector<FlatDisk> added, removed;
};
/// Cuts rounded corners that point outwards off and adds a disk there; fills the others, and
/// removes a disk there.
RoundedParts parts_of(const RoundedPolygon& polygon, int sides);

/// The outline with facets no more than `sagitta` off the arcs.
FlatLoops outline_of(const RoundedPolygon& polygon, double sagitta);

/// Whether both figures are the same except for slivers narrower than `width`.
bool are_alike(const FlatLoops& a, const FlatLoops& b, double width);

}  // namespace graycube
