// One coordinate of a cubic Bézier segment: Σ bᵢ Bᵢ³(v) for v in [0, 1].
#pragma once

#include <array>
#include <utility>

namespace graycube {

struct Cubic {
  std::array<double, 4> b{};

  double at(double v) const {
    const double p = between(b[0], b[1], v), q = between(b[1], b[2], v), r = between(b[2], b[3], v);
    return between(between(p, q, v), between(q, r, v), v);
  }
  double slope(double v) const {
    const double p = b[1] - b[0], q = b[2] - b[1], r = b[3] - b[2];
    return 3 * between(between(p, q, v), between(q, r, v), v);
  }
  /// The parts before and after v, by de Casteljau's construction; they share the point at v.
  std::pair<Cubic, Cubic> split(double v) const {
    const double p = between(b[0], b[1], v), q = between(b[1], b[2], v), r = between(b[2], b[3], v);
    const double pq = between(p, q, v), qr = between(q, r, v), middle = between(pq, qr, v);
    return {{{b[0], p, pq, middle}}, {{middle, qr, r, b[3]}}};
  }

 private:
  static double between(double from, double to, double v) { return from + v * (to - from); }
};

}  // namespace graycube
