// What loops of the plane enclose.
#pragma once

#include <cstddef>

#include "flat/polygon.hpp"

namespace graycube::testing {

/// The area, holes subtracted: loops that turn clockwise count negative.
inline double area(const FlatLoops& loops) {
  double sum = 0;
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
  }
  return sum;
}

}  // namespace graycube::testing
