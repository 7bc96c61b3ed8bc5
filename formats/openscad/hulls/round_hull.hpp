// Convex hulls of balls, or of level discs, and points, exactly: which of them show, which pairs
// are bridged by a cone, and the planes that touch three or more.
//
// Both kinds are reached alike: a set with centre c and radius r reaches c · u + r in the direction
// u, when u is scaled so that its length is 1 for balls, and the length of its level part for
// discs. The directions in which a pair reaches equally far, and further than all others, are arcs
// of a circle; their ends are the planes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace graycube {

/// A ball, or a disc parallel to z = 0; with radius 0, a point.
struct RoundPoint {
  Vec3 center;
  double radius = 0;
  friend bool operator==(const RoundPoint&, const RoundPoint&) = default;
};
enum class RoundKind : std::uint8_t { kBalls, kDiscs };

/// The hull is the union of the hull of `core`, of the hulls of the pairs in `bridges`, and of the
/// balls in `corners`.
struct RoundHull {
  RoundKind kind = RoundKind::kBalls;
  /// The given points that show in the hull, or could.
  std::vector<RoundPoint> points;
  /// Pairs of indices into `points`.
  std::vector<std::pair<std::size_t, std::size_t>> bridges;
  /// Indices of balls in `points`; empty for discs, which end their bridges.
  std::vector<std::size_t> corners;
  /// The planes that touch three or more of the points but aren't level, unit normals outwards.
  std::vector<HalfSpaceShape> planes;
  /// The points at which the planes touch, and all others that belong to the core.
  std::vector<Vec3> core;
};

/// The most points with a radius, points in all, and arcs that are cut for them.
inline constexpr std::size_t kMaxRoundPoints = 256;
inline constexpr std::size_t kMaxHullPoints = std::size_t{1} << 12;
inline constexpr std::size_t kMaxHullArcs = std::size_t{1} << 26;

/// Nothing beyond these limits. At least one point must have a radius; every number must be finite,
/// and radii ≥ 0.
std::optional<RoundHull> round_hull(RoundKind kind, std::vector<RoundPoint> points);

/// The points without those that lie in the hull of others, as far as that is quickly seen.
std::vector<RoundPoint> without_hidden(RoundKind kind, std::vector<RoundPoint> points);

}  // namespace graycube
