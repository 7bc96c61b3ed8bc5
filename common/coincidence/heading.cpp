#include "coincidence/heading.hpp"

#include <cmath>
#include <tuple>

namespace graycube::csg {

Measured direction_number(const Heading& heading, int which) {
  const Vec3& n = heading.normal;
  const double tolerance = 2 * heading.tolerance;
  switch (which) {
    case 0: {
      const double along = dot(kGenericDirection, n);
      return {along * along, tolerance};
    }
    // Products of two coordinates are the same for a direction and its opposite.
    case 1: return {n.x * n.y, tolerance};
    case 2: return {n.y * n.z, tolerance};
    case 3: return {n.z * n.x, tolerance};
    case 4: return {n.x * n.x, tolerance};
    default: return {n.y * n.y, tolerance};
  }
}

int world_axis_of(const Heading& heading) {
  const Vec3& n = heading.normal;
  for (int a = 0; a < 3; ++a) {
    const double beside = larger(std::fabs(n[(a + 1) % 3]), std::fabs(n[(a + 2) % 3]));
    if (beside <= heading.tolerance) return a;
  }
  return 3;
}

Vec3 turned_first(const Vec3& direction) {
  const Vec3& n = direction;
  const bool is_backward = n.x != 0 ? n.x < 0 : n.y != 0 ? n.y < 0 : n.z < 0;
  return is_backward ? -n + Vec3{} : n;
}

bool is_better_direction(const Heading& a, const Heading& b) {
  if (a.tolerance != b.tolerance) return a.tolerance < b.tolerance;
  const Vec3 u = turned_first(a.normal), v = turned_first(b.normal);
  return std::tie(u.x, u.y, u.z) < std::tie(v.x, v.y, v.z);
}

}  // namespace graycube::csg
