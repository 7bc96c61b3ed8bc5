// Round surfaces as told by the corners of the facets that OpenSCAD gives them: two of them are one
// where their corners are.
#pragma once

#include <cstdint>
#include <vector>

#include "flat/polygon.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// All lengths and places are those of the world.
struct RoundRing {
  enum class Kind : std::uint8_t { kCylinder, kBall, kTurned };
  Kind kind = Kind::kCylinder;
  /// A cylinder's direction, of length 1. Else the radius of the ball, or of the circle that is
  /// turned, along the axis.
  Vec3 along;
  /// A cylinder's centre and corners are as seen along its direction.
  Vec3 center;
  /// Corners around the axis: a ball's where it is widest, those of what is turned where it reaches
  /// farthest.
  std::vector<Vec3> corners;
  /// The corners of the circle that is turned: x in distances of `corners` from the axis, y in
  /// lengths of `along`.
  FlatLoop profile;
};

/// An upright cylinder around the image of the unit disk, with corners from angle 0 on.
RoundRing cylinder_ring(const FlatMap& disk, int sides, const Affine& to_world);
/// OpenSCAD's sphere(): see faceted_sphere().
RoundRing ball_ring(double radius, int sides, const Affine& to_world);
/// A circle with these corners turned about z in `steps` steps, as rotate_extrude() does: x becomes
/// the distance from the axis. Its centre may lie on the axis.
RoundRing turned_ring(const FlatLoop& circle, const FlatPoint& center, double radius, int steps,
                      const Affine& to_world);

/// Whether the facets are the same, where coordinates may be off by this share of their size.
bool are_one(const RoundRing& a, const RoundRing& b, double share);

/// Closed lines along edges between facets: a cylinder's as seen along its direction, all that go
/// round the axis of others. None if there are more than kMaxOpenscadFacets corners.
std::vector<std::vector<Vec3>> edge_lines(const RoundRing& ring);

/// The part of `v` across a direction of length 1.
inline Vec3 across(const Vec3& v, const Vec3& along) { return v - dot(along, v) * along; }

}  // namespace graycube
