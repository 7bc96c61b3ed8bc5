// Directions as places on the faces of a cube. Face 2 · a holds the directions whose largest
// component is along +axis a, face 2 · a + 1 those along −axis a; u goes along axis a + 1 and v
// along axis a + 2 (mod 3), each from 0 to 1.
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

/// The place of a direction. The first of the largest components decides the face. Written without
/// branches: shadow rays of one wave go to several faces, which no processor predicts.
inline CubePlace cube_place(const Vec3& d) {
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  const bool is_x = x >= y && x >= z, is_y = !is_x && y >= z;
  const auto select = [&](double of_x, double of_y, double of_z) {
    const double others = is_y ? of_y : of_z;
    return is_x ? of_x : others;
  };
  const double main = select(d.x, d.y, d.z);
  const double scale = 0.5 / std::fabs(main);
  const std::size_t axis = is_x ? 0 : 2 - std::size_t{is_y};
  return {2 * axis + (main < 0 ? 1 : 0), select(d.y, d.z, d.x) * scale + 0.5,
          select(d.z, d.x, d.y) * scale + 0.5};
}

/// The direction of a place; not of unit length.
inline Vec3 cube_direction(const CubePlace& place) {
  const int axis = static_cast<int>(place.face / 2);
  Vec3 d;
  d[axis] = place.face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = 2 * place.u - 1;
  d[(axis + 2) % 3] = 2 * place.v - 1;
  return d;
}

/// The number of the cell, among `count` of width 1, in which a coordinate from 0 to `count` lies.
/// NaN, which no unit vector gives, and values that rounding took past an end give a valid cell.
inline std::uint32_t cell_at(double at, std::uint32_t count) {
  return at > 0 ? std::min(static_cast<std::uint32_t>(at), count - 1) : 0;
}

/// The number of the texel of a place, on faces of side × side texels: face by face, row by row.
inline std::size_t cube_texel(const CubePlace& place, std::uint32_t side) {
  return (place.face * side + cell_at(place.v * side, side)) * side + cell_at(place.u * side, side);
}

}  // namespace graycube
