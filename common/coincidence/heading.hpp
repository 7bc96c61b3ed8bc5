// Directions of plane faces, without a sense: a face and the face that it lies upon look opposite
// ways.
#pragma once

#include <cstdint>

#include "coincidence/clusters.hpp"
#include "geometry/vec.hpp"

namespace graycube::csg {

/// One or two faces of a primitive that have the same direction: number `slot` and, for a pair
/// (coincidence/faces.hpp), slot + 1.
struct Heading {
  Vec3 normal;
  /// How far off the normal may be, in radians.
  double tolerance = 0;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
  std::uint32_t count = 1;
};

/// A direction that no model is likely to have two different things across.
inline constexpr Vec3 kGenericDirection{0.5359, 0.6411, 0.5497};

/// Numbers that tell directions apart and are the same for opposite ones. The first alone differs
/// for nearly all directions that differ.
inline constexpr int kDirectionNumbers = 6;
Measured direction_number(const Heading& heading, int which);

/// The number of the world's axis that the heading is along, to within its tolerance; 3 if none.
int world_axis_of(const Heading& heading);
inline Vec3 world_axis(int axis) {
  Vec3 e;
  e[axis] = 1;
  return e;
}

/// The direction or its opposite, whichever has its first coordinate other than 0 positive: an
/// arbitrary but fixed choice.
Vec3 turned_first(const Vec3& direction);
/// Whether `a` is known better than `b`, or comes first if both are known equally well.
bool is_better_direction(const Heading& a, const Heading& b);

}  // namespace graycube::csg
