#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// The points with normal · p ≤ offset; the normal is unit.
struct Plane {
  Vec3 normal;
  double offset = 0;

  friend bool operator==(const Plane&, const Plane&) = default;
};

/// The point of the plane that is nearest to `p`.
constexpr Vec3 nearest_on(const Plane& plane, const Vec3& p) {
  return p + (plane.offset - dot(plane.normal, p)) * plane.normal;
}

}  // namespace graycube
