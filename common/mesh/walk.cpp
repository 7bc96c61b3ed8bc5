#include "mesh/walk.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/interval.hpp"
#include "geometry/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "mesh/walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

void AddCuts(const MeshTree& tree, const csg::MeshLine& line, const Ray& ray, double least,
             double below, std::vector<MeshCut>& cuts) {
  if (tree.nodes().empty()) return;
  const bool is_ahead = least >= 0;
  const CullingRay culling(is_ahead ? ray : Ray{ray.origin, -ray.direction});
  const float from = static_cast<float>(is_ahead ? least : -below) * (1 - kSlack);
  const float to = static_cast<float>(is_ahead ? below : -least) * (1 + kSlack) + 1e-37f;
  add_cuts_below(tree, 0, culling, from, to, line, ray, least, below, cuts);
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(AddCuts);

void add_cuts(const MeshTree& tree, const csg::MeshLine& line, const Ray& ray, double least,
              double below, std::vector<MeshCut>& cuts) {
  GRAYCUBE_SIMD_CALL(AddCuts)(tree, line, ray, least, below, cuts);
}

namespace csg {

double triangle_parameter(const MeshLine& line, const Ray& ray, const Vec3& a, const Vec3& b,
                          const Vec3& c) {
  // The most, as a share, by which rounding may exceed the corners' parameters.
  constexpr double kSlackOfParameter = 1e-12;
  const double ta = line.parameter(a), tb = line.parameter(b), tc = line.parameter(c);
  const double least = std::min(ta, std::min(tb, tc)), most = std::max(ta, std::max(tb, tc));
  const Vec3 normal = normalized(cross(b - a, c - a));
  const double slope = dot(normal, ray.direction);
  double t = 0;
  if (std::fabs(slope) > kLeastSine * max_abs(ray.direction)) {
    t = plane_parameter(dot(normal, a), dot(normal, ray.origin), 1.0 / slope);
    const double slack = kSlackOfParameter * (std::fabs(least) + std::fabs(most));
    if (t >= least - slack && t <= most + slack) return t + 0.0;
  } else {
    const LinePoint p = line.see(a), q = line.see(b), r = line.see(c);
    const double u = q.x * r.y - q.y * r.x, v = r.x * p.y - r.y * p.x, w = p.x * q.y - p.y * q.x;
    t = (u * ta + v * tb + w * tc) / (u + v + w);
  }
  // NaN, which triangles without an area give, becomes the first corner reached.
  return (t >= least ? (t <= most ? t : most) : least) + 0.0;
}

}  // namespace csg
}  // namespace graycube
#endif
