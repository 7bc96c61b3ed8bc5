// How far the numbers of a leaf reach, which is what their rounding errors are measured by.
#pragma once

#include "csg/primitive.hpp"
#include "scene/scene.hpp"

namespace graycube {

struct LeafReach {
  /// The largest absolute coordinates of the shape's points along each of its own axes; a little
  /// more is fine.
  Vec3 most;
  /// How many times worse its directions are known than its numbers, at least 1: an axis between
  /// two points far away is known as badly as they are by the distance between them.
  double turn = 1;
};

/// Of every kind of leaf but prisms, which become others. `built` is the leaf's primitive under
/// `to_world`; of polyhedra its bounds tell how far they reach.
LeafReach reach_of(const CsgNode& leaf, const Primitive& built, const Affine& to_world);

}  // namespace graycube
