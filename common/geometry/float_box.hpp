// Boxes in floats, of which hierarchies of boxes are made.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "geometry/aabb.hpp"
#include "geometry/culling_ray.hpp"
#include "geometry/infinity.hpp"

namespace graycube {

/// A box that isn't initialized: there may be many of which few are used.
struct FloatBox {
  std::array<float, 3> lo, hi;

  static constexpr FloatBox nothing() {
    return {{kFloatInf, kFloatInf, kFloatInf}, {-kFloatInf, -kFloatInf, -kFloatInf}};
  }
  void include(const FloatBox& o) {
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], o.lo[a]);
      hi[a] = std::max(hi[a], o.hi[a]);
    }
  }
  /// Half the surface area; meaningful for finite boxes only.
  float half_area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }
  /// Halves are added, so that the sum of large coordinates stays finite.
  float center(std::size_t a) const { return 0.5f * lo[a] + 0.5f * hi[a]; }
};

inline FloatBox union_of(FloatBox a, const FloatBox& b) {
  a.include(b);
  return a;
}

/// The smallest box in floats that holds all of a box.
inline FloatBox float_box_around(const Aabb& box) {
  FloatBox around;
  for (std::size_t a = 0; a < 3; ++a) {
    around.lo[a] = float_below(box.lo[static_cast<int>(a)]);
    around.hi[a] = float_above(box.hi[static_cast<int>(a)]);
  }
  return around;
}
inline FloatBox float_box_around(const FloatBox& box) { return box; }

}  // namespace graycube
