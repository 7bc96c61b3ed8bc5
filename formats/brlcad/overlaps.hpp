// Pairs of regions that fill the same space, which no two parts of a real thing can.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

/// Regions that reach into each other less than this (mm) touch: what rt takes for one surface.
inline constexpr double kLeastBrlcadOverlap = 0.0005;
/// Most pairs that are found, and most times that a line is met with a primitive or that two
/// objects are compared: beyond that the search ends.
inline constexpr std::size_t kMaxBrlcadOverlaps = 1000;
inline constexpr std::uint64_t kMaxOverlapWork = 30'000'000;

struct BrlcadOverlap {
  /// Objects of the model, the first before the second.
  std::uint32_t first = 0, second = 0;
  /// A point within both, and how far both reach along the line through it.
  Vec3 point;
  double depth = 0;
};

struct BrlcadOverlaps {
  std::vector<BrlcadOverlap> pairs;
  /// Whether all pairs whose bounds meet were looked at.
  bool is_whole = true;
};

/// Looks along a grid of lines through the space that the bounds of each two objects share. What is
/// found is so; an overlap that no line meets is not found. A pair comes with its deepest place.
BrlcadOverlaps find_brlcad_overlaps(const Model& model);

}  // namespace graycube
