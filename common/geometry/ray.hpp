#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// The points origin + t · direction. Directions are unit vectors wherever rays are traced.
struct Ray {
  Vec3 origin;
  Vec3 direction;

  constexpr Vec3 at(double t) const { return origin + t * direction; }
  friend constexpr bool operator==(const Ray&, const Ray&) = default;
};

}  // namespace graycube
