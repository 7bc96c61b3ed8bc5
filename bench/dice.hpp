// Random numbers from a seed, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "geometry/vec.hpp"

namespace graycube::bench {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  Vec3 point_between(const Vec3& lo, const Vec3& hi) {
    const double x = between(lo.x, hi.x);
    const double y = between(lo.y, hi.y);
    return {x, y, between(lo.z, hi.z)};
  }
  /// A direction uniform on the unit sphere.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = point_between({-1, -1, -1}, {1, 1, 1});
      const double l = length(v);
      if (l > 0.01 && l < 1) return normalized(v);
    }
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace graycube::bench
