#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// A point of a surface as a ray sees it.
struct SurfaceView {
  /// The unit normal on the viewer's side, and the unit direction to the viewer.
  Vec3 normal, to_viewer;
  /// Whether the viewer is within the solid.
  bool is_within = false;
};

}  // namespace graycube
