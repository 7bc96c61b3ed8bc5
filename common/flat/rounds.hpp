// Exact convex hulls of disks and points of the plane: disks, and the polygon of the points at
// which tangents touch them.
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
  /// The number of sides that OpenSCAD would give the disk; 0 for a point.
  int sides = 0;
  friend bool operator==(const FlatDisk&, const FlatDisk&) = default;
};

/// The hull is the union of the polygon and the disks.
struct FlatRoundHull {
  /// Counter-clockwise and convex; fewer than three corners for a single disk.
  FlatLoop polygon;
  /// The indices of the disks that are part of the hull's outline, ascending.
  std::vector<std::size_t> disks;
};

/// The most pairs that are compared; each takes a few nanoseconds.
inline constexpr std::size_t kMaxFlatDiskPairs = std::size_t{1} << 24;

/// The number of disks with a radius times that of all disks must be at most kMaxFlatDiskPairs.
FlatRoundHull flat_round_hull(std::span<const FlatDisk> disks);

}  // namespace graycube
