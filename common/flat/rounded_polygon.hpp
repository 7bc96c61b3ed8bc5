// Polygons with rounded corners: offset one after another, their sides move and the corners' radii
// add up, as long as no side vanishes and none meets another.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"
#include "flat/rounds.hpp"

namespace graycube {

struct RoundedLoop {
  /// Where the sides would meet; the inside is on the left.
  FlatLoop corners;
  /// Of the arc that touches both sides at each corner; 0 for a sharp one.
  std::vector<double> radii;
};
using RoundedPolygon = std::vector<RoundedLoop>;

/// Outlines counter-clockwise and holes clockwise, as Clipper leaves them; empty beyond
/// kMaxRoundedCorners.
RoundedPolygon sharp_polygon(const FlatLoops& loops);

/// Moved outwards by the distance, inwards where it is negative. Sharp corners become round where
/// the distance leaves a gap, if `rounds_corners`, and stay sharp else. Nothing where a side
/// vanishes or an arc doesn't fit.
std::optional<RoundedPolygon> moved(const RoundedPolygon& polygon, double distance,
                                    bool rounds_corners);

/// The polygon and the disks of `added`, less the disks of `removed`.
struct RoundedParts {
  FlatLoops polygon;
  std::vector<FlatDisk> added, removed;
};
/// Corners that point outwards are cut off and given a disk; the others are filled, and a disk
/// taken off.
RoundedParts parts_of(const RoundedPolygon& polygon, int sides);

/// The outline with facets no more than `sagitta` off the arcs.
FlatLoops outline_of(const RoundedPolygon& polygon, double sagitta);

/// Whether both are the same but for slivers narrower than `width`.
bool are_alike(const FlatLoops& a, const FlatLoops& b, double width);

}  // namespace graycube
