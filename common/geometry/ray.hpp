#pragma once

#include "geometry/vec.hpp"

namespace graycube {

/// The points origin + t · direction. Directions are unit vectors wherever rays are traced.
struct Ray {
  Vec3 origin;
  Vec3 direction;

  constexpr Vec3 at(double t) const { return origin + t * direction; }
};

}  // namespace graycube
