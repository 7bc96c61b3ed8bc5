// Random numbers from a seed, the same on every machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "geometry/vec.hpp"

namespace graycube::testing {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  double sign() { return one_in(2) ? 1 : -1; }
  /// A multiple of 1/2 in [−reach, reach]: coordinates of this kind coincide often.
  double on_grid(int reach) {
    return 0.5 * (static_cast<double>(below(static_cast<std::size_t>(4 * reach + 1))) - 2 * reach);
  }
  Vec3 grid_point(int reach) { return {on_grid(reach), on_grid(reach), on_grid(reach)}; }
  Vec3 point(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
  }
  Vec3 unit_vector() {
    for (;;) {
      const Vec3 v = point(1);
      const double l = length(v);
      if (l > 0.01 && l < 1) return normalized(v);
    }
  }
  /// A direction along a world axis.
  Vec3 axis() {
    Vec3 v;
    v[static_cast<int>(below(3))] = sign();
    return v;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace graycube::testing
