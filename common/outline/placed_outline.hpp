// An outline as a primitive has it: where its plane and axis lie in the world.
#pragma once

#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "outline/outline.hpp"

namespace graycube {

struct PlacedOutline {
  const Outline& outline;
  /// World → the outline's frame, whose z is the axis of the turn or the direction of the sweep.
  const Affine& to_local;
  /// Of the solid, in the world.
  const Aabb& bounds;
  /// The ends of a sweep are planes of the world, with this unit normal and these offsets.
  Vec3 cap_normal;
  double lower_cap = 0, upper_cap = 0;
};

}  // namespace graycube
