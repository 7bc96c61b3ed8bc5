// Rays that are traced together, because they mostly go the same way: a block of neighbouring
// primary rays, or the shadow rays of such a block towards one light. The result for a ray never
// depends on the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/ray.hpp"

namespace graycube {

/// Up to kSize rays, stored as one array for each coordinate.
struct RayPacket {
  static constexpr std::size_t kSize = 16;
  /// Bit i stands for ray i.
  using Mask = std::uint32_t;

  std::uint32_t count = 0;
  alignas(64) std::array<std::array<double, kSize>, 3> origin;
  alignas(64) std::array<std::array<double, kSize>, 3> direction;
  /// Each ray looks for crossings with t0 ≤ t < t1.
  alignas(64) std::array<double, kSize> t0;
  alignas(64) std::array<double, kSize> t1;

  void clear() { count = 0; }
  bool is_full() const { return count == kSize; }
  Mask all() const { return (Mask{1} << count) - 1; }
  /// The packet must not be full.
  void add(const Ray& ray, double from, double to) {
    for (std::size_t a = 0; a < 3; ++a) {
      origin[a][count] = ray.origin[static_cast<int>(a)];
      direction[a][count] = ray.direction[static_cast<int>(a)];
    }
    t0[count] = from;
    t1[count] = to;
    ++count;
  }
  Ray ray(std::size_t i) const {
    return {{origin[0][i], origin[1][i], origin[2][i]},
            {direction[0][i], direction[1][i], direction[2][i]}};
  }
};

}  // namespace graycube
