// Directions of plane faces, which have no sense: a face and the one that it lies upon look
// opposite ways.
#pragma once

#include <cstdint>

#include "coincidence/clusters.hpp"
#include "geometry/vec.hpp"

namespace graycube::csg {

/// One or two faces of a primitive with one direction: those numbered `slot` and, of a pair
/// (coincidence/faces.hpp), slot + 1.
struct Heading {
  Vec3 normal;
  /// Radians.
  double tolerance = 0;
  std::uint32_t primitive = 0;
  std::uint32_t slot = 0;
  std::uint32_t count = 1;
};

/// A direction that no model is likely to have two different things across.
inline constexpr Vec3 kGenericDirection{0.5359, 0.6411, 0.5497};

/// Numbers that tell directions apart, the same for opposite ones. By the first nearly all part
/// that differ.
inline constexpr int kDirectionNumbers = 6;
Measured direction_number(const Heading& heading, int which);

/// The world's axis that the heading is along, to within its tolerance; 3 for none.
int world_axis_of(const Heading& heading);
inline Vec3 world_axis(int axis) {
  Vec3 e;
  e[axis] = 1;
  return e;
}

/// Of a direction and its opposite the one that comes first; a choice among bits, not a
/// measurement.
Vec3 turned_first(const Vec3& direction);
/// Whether the first is known better, or comes first where both are known as well.
bool is_better_direction(const Heading& a, const Heading& b);

}  // namespace graycube::csg
