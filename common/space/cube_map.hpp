// Directions on the faces of a cube. Face 2 · a is that of directions whose largest component is +axis a, 2 · a + 1
// that of −axis a; u goes along axis a + 1 and v along axis a + 2 (mod 3), each from 0 to 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/vec.hpp"

namespace graycube {

struct CubePlace {
  std::size_t face;
  double u, v;
};

constexpr std::size_t cube_texels(std::uint32_t side) { return std::size_t{6} * side * side; }

inline CubePlace cube_place(const Vec3& direction) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::fabs(direction[a]) > std::fabs(direction[axis])) axis = a;
  }
  const double scale = 0.5 / std::fabs(direction[axis]);
  return {static_cast<std::size_t>(2 * axis + (direction[axis] < 0 ? 1 : 0)),
          direction[(axis + 1) % 3] * scale + 0.5, direction[(axis + 2) % 3] * scale + 0.5};
}

/// The direction, not of unit length, of a place.
inline Vec3 cube_direction(const CubePlace& place) {
  const int axis = static_cast<int>(place.face / 2);
  Vec3 d;
  d[axis] = place.face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = 2 * place.u - 1;
  d[(axis + 2) % 3] = 2 * place.v - 1;
  return d;
}

/// Which of `count` cells of width 1 a coordinate from 0 to `count` is in. Written so that NaN, which no unit vector
/// gives, and what rounding takes beyond either end stay within.
inline std::uint32_t cell_at(double at, std::uint32_t count) {
  return at > 0 ? std::min(static_cast<std::uint32_t>(at), count - 1) : 0;
}

/// Of faces of side × side texels, one behind the other, row after row.
inline std::size_t cube_texel(const CubePlace& place, std::uint32_t side) {
  return (place.face * side + cell_at(place.v * side, side)) * side + cell_at(place.u * side, side);
}

}  // namespace graycube
