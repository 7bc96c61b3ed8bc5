// On which side of planes across the axes a ray is, and when.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/aabb.hpp"
#include "geometry/ray.hpp"

namespace graycube {

/// The parameter at which a ray leaves a cell, and the face (axis · 2 + upper) through which it
/// does; face −1 when it stays for good.
struct CellExit {
  double t = kInf;
  int face = -1;
};

/// A ray prepared for comparing plane parameters with t; sides are never decided by coordinates.
class PlaneOrder {
 public:
  explicit PlaneOrder(const Ray& ray) : origin_(ray.origin) {
    for (int a = 0; a < 3; ++a) {
      const double d = ray.direction[a];
      const double inverse = 1.0 / d;
      const bool moves = std::isfinite(inverse);
      inverse_[a] = moves ? inverse : 0;
      sense_[static_cast<std::size_t>(a)] = !moves ? 0 : d > 0 ? 1 : -1;
    }
  }

  /// 1 or −1 where the ray moves up or down along the axis, 0 where it doesn't move.
  int sense(int axis) const { return sense_[static_cast<std::size_t>(axis)]; }
  double origin(int axis) const { return origin_[axis]; }
  double parameter(int axis, double at) const { return (at - origin_[axis]) * inverse_[axis]; }
  /// Whether the ray is on the upper side of the plane at parameter t.
  bool is_above(int axis, double at, double t) const {
    switch (sense(axis)) {
      case 1: return t >= parameter(axis, at);
      case -1: return t < parameter(axis, at);
      default: return origin_[axis] >= at;
    }
  }

 private:
  Vec3 origin_, inverse_;
  std::array<int, 3> sense_{};
};

inline CellExit exit_of(const Aabb& cell, const PlaneOrder& order) {
  CellExit exit;
  for (int a = 0; a < 3; ++a) {
    const int sense = order.sense(a);
    if (sense == 0) continue;
    const double at = sense > 0 ? cell.hi[a] : cell.lo[a];
    if (!std::isfinite(at)) continue;
    const double t = order.parameter(a, at);
    if (exit.face < 0 || t < exit.t) exit = {t, a * 2 + (sense > 0 ? 1 : 0)};
  }
  return exit;
}

}  // namespace graycube
