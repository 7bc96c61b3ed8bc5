// Axis-aligned boxes, possibly unbounded (±infinity) on any side.
#pragma once

#include "geometry/infinity.hpp"
#include "geometry/vec.hpp"

namespace graycube {

struct Aabb {
  Vec3 lo{-kInf, -kInf, -kInf};
  Vec3 hi{kInf, kInf, kInf};

  static constexpr Aabb everything() { return {}; }
  static constexpr Aabb nothing() { return {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}}; }

  bool is_empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  bool is_finite() const { return graycube::is_finite(lo) && graycube::is_finite(hi); }
  bool contains(const Vec3& p) const {
    return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
  }
  /// Touching counts as overlapping.
  bool overlaps(const Aabb& o) const {
    return lo.x <= o.hi.x && hi.x >= o.lo.x && lo.y <= o.hi.y && hi.y >= o.lo.y && lo.z <= o.hi.z &&
           hi.z >= o.lo.z;
  }
  Aabb grown(double by) const {
    return {{lo.x - by, lo.y - by, lo.z - by}, {hi.x + by, hi.y + by, hi.z + by}};
  }
  /// Corner number 0 … 7; bit a selects `hi` on axis a.
  Vec3 corner(int i) const {
    return {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z};
  }
  Vec3 center() const { return 0.5 * (lo + hi); }
  /// Half the surface area; meaningful for finite boxes only.
  double half_area() const {
    const Vec3 e = hi - lo;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
  void include(const Vec3& p) {
    for (int a = 0; a < 3; ++a) {
      if (p[a] < lo[a]) lo[a] = p[a];
      if (p[a] > hi[a]) hi[a] = p[a];
    }
  }
  friend constexpr bool operator==(const Aabb&, const Aabb&) = default;
};

inline Aabb intersection_of(const Aabb& a, const Aabb& b) {
  Aabb r;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = a.lo[i] > b.lo[i] ? a.lo[i] : b.lo[i];
    r.hi[i] = a.hi[i] < b.hi[i] ? a.hi[i] : b.hi[i];
  }
  return r;
}

inline Aabb union_of(const Aabb& a, const Aabb& b) {
  Aabb r;
  for (int i = 0; i < 3; ++i) {
    r.lo[i] = a.lo[i] < b.lo[i] ? a.lo[i] : b.lo[i];
    r.hi[i] = a.hi[i] > b.hi[i] ? a.hi[i] : b.hi[i];
  }
  return r;
}

}  // namespace graycube
