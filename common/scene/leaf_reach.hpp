// How large the numbers of a leaf are, by which their rounding errors are measured.
#pragma once

#include "csg/primitive.hpp"
#include "scene/scene.hpp"

namespace graycube {

struct LeafReach {
  /// The largest absolute coordinates of the shape's points along each of its own axes; a little
  /// more is fine.
  Vec3 most;
  /// The factor, at least 1, by which its directions are known worse than its numbers: an axis
  /// between two points far away is as uncertain as their error over their distance.
  double turn = 1;
};

/// The reach of any kind of leaf but prisms and Bézier nets, which become other kinds. `built` is
/// the leaf's primitive under `to_world`, whose bounds give the reach of a polyhedron.
LeafReach reach_of(const CsgNode& leaf, const Primitive& built, const Affine& to_world);

}  // namespace graycube
