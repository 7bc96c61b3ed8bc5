// Convex hulls of disks and points of the plane, exactly: disks, and the polygon of the points
// where tangents touch.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// A disk, or a point where the radius is 0.
struct FlatDisk {
  FlatPoint center;
  double radius = 0;
  /// What OpenSCAD makes of it; 0 for a point.
  int sides = 0;
  friend bool operator==(const FlatDisk&, const FlatDisk&) = default;
};

/// The hull is the union of the polygon and the disks.
struct FlatRoundHull {
  /// Counter-clockwise and convex; fewer than three corners for a single disk.
  FlatLoop polygon;
  /// Which of the disks show, ascending.
  std::vector<std::size_t> disks;
};

/// Pairs of disks that are compared at most; time is a few nanoseconds each.
inline constexpr std::size_t kMaxFlatDiskPairs = std::size_t{1} << 24;

/// Needs at most kMaxFlatDiskPairs products of disks with a radius and all points.
FlatRoundHull flat_round_hull(std::span<const FlatDisk> disks);

}  // namespace graycube
