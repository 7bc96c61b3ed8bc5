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
  enum class Kind : std::uint8_t { kCylinder, kCone, kBall, kTurned };
  Kind kind = Kind::kCylinder;
  /// A cylinder's direction, of length 1. The way from the centre of a cone's wide end to that of
  /// its narrow end, perhaps of length 0 if it has none. Else a length along the axis, such as the
  /// radius of the ball.
  Vec3 along;
  /// A cylinder's centre and corners are as seen along its direction, a cone's those of its wide
  /// end.
  Vec3 center;
  /// Corners around the axis: a ball's where it is widest, those of what is turned where it reaches
  /// farthest.
  std::vector<Vec3> corners;
  /// The corners of the outline that is turned: x in distances of `corners` from the axis, y in
  /// lengths of `along`.
  FlatLoop profile;
  /// The share of its radius that a cone loses on the way `along`.
  double narrowing = 0;
  /// A cone's normal · (p − center) is 0 at its wide end and 1 at its narrow one.
  Vec3 normal;
  /// Whether it goes round by less than 360°, so that the first corner doesn't follow the last.
  bool is_open = false;
};

/// The angles in degrees at which a round surface has corners.
struct RingAngles {
  std::vector<double> degrees;
  bool is_open = false;
};
/// `sides` angles all around.
RingAngles whole_ring(int sides, double start = 0);
/// Those of a turn by `angle` in so many steps. It counts as a part of a whole ring if its steps
/// could go all around.
RingAngles turn_ring(double start, double angle, int steps);

/// An upright cylinder around the image of the unit disk.
RoundRing cylinder_ring(const FlatMap& disk, const RingAngles& angles, const Affine& to_world);
/// A cone whose wide end is the image of the unit disk at the height `wide_z`; the other end, with
/// 0 ≤ `ratio` < 1 times its radius, lies around `narrow`.
RoundRing cone_ring(const FlatMap& disk, double wide_z, const Vec3& narrow, double ratio,
                    const RingAngles& angles, const Affine& to_world);
/// OpenSCAD's sphere(): see faceted_sphere().
RoundRing ball_ring(double radius, int sides, const Affine& to_world);
/// An outline turned about z, as rotate_extrude() does: x becomes the distance from the axis.
/// `center` is what its corners lie around, and may lie on the axis; `reach`: how far they lie from
/// it in x and in y.
RoundRing turned_ring(const FlatLoop& outline, const FlatPoint& center, const FlatPoint& reach,
                      const RingAngles& angles, const Affine& to_world);

/// Whether the facets are the same, where coordinates may be off by this share of their size.
bool are_one(const RoundRing& a, const RoundRing& b, double share);

/// Closed lines along edges between facets, or open ones of an open ring: a cylinder's as seen
/// along its direction, a cone's at its wide end, all that go round the axis of others. None if
/// there are more than kMaxOpenscadFacets corners.
std::vector<std::vector<Vec3>> edge_lines(const RoundRing& ring);

/// The part of `v` across a direction of length 1.
inline Vec3 across(const Vec3& v, const Vec3& along) { return v - dot(along, v) * along; }

/// A point as a ring's corners see it: moved along a cylinder, or along the lines through a cone's
/// tip to its wide end.
struct SeenPoint {
  Vec3 place;
  /// The factor by which lengths across the axis are smaller than at the corners; 0 or less at the
  /// tip and beyond.
  double size = 1;
  /// How far along the cone it lies, in lengths of `along`.
  double height = 0;
};
SeenPoint seen_by(const RoundRing& ring, const Vec3& point);

}  // namespace graycube
