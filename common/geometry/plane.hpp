#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// The points with normal · p ≤ offset; the normal is unit.
struct Plane {
  Vec3 normal;
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

}  // namespace graycube
