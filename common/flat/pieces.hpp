// A polygon as convex pieces less convex pieces: its hull, less the pockets between hull and
// outline, less the holes, each of them cut up in the same way (a convex difference tree: Batchelor
// 1980). Unlike a partition it has no seams inside the polygon, at which rays could slip through by
// a rounding error.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// The points with normal · p ≤ offset; the normal is unit, and exactly so along an axis.
struct FlatEdge {
  FlatPoint normal;
  double offset = 0;
};

/// The points within all edges and in none of `less`.
struct FlatPiece {
  std::vector<FlatEdge> edges;
  /// Corners of the convex part, up to rounding: good for bounds.
  FlatLoop corners;
  std::vector<FlatPiece> less;
};

/// The most levels of pieces within pieces.
inline constexpr int kMaxPieceLevels = 64;

/// The polygon as the union of pieces, one for each connected part; parts whose pockets nest too
/// deep are cut in two along a line x = constant. At its opening a pocket's piece reaches out of
/// the hull, so that the two have no edge in common. Nothing when an outline still crosses itself
/// after Clipper has resolved it.
std::optional<std::vector<FlatPiece>> flat_pieces(const FlatLoops& loops);

/// The edge from a to b of a polygon on its left. Both directions give the same numbers, signs
/// apart.
FlatEdge edge_between(const FlatPoint& a, const FlatPoint& b);

}  // namespace graycube
