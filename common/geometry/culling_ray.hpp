// Boxes and rays in floats, made so that no box which the exact ray meets is missed. They only
// cull: which boxes a ray passes never shows in a result.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/infinity.hpp"
#include "geometry/ray.hpp"

namespace graycube {

/// A bound, with room to spare, of a float plane parameter's relative error: the direction, its
/// reciprocal and the slack itself, a difference and a product are each rounded once.
inline constexpr float kSlack = 1e-6f;
/// Smaller direction components are taken as this: such a ray doesn't move sideways in any scene.
inline constexpr float kFlattest = 1e-30f;

/// The nearest float not above (not below) a double.
inline float float_below(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) > v ? std::nextafterf(f, -kFloatInf) : f;
}
inline float float_above(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafterf(f, kFloatInf) : f;
}

/// One coordinate of a ray: distances to near planes are taken from a little ahead of the origin,
/// those to far planes from a little behind it, and the reciprocals carry the slack.
struct CullingAxis {
  CullingAxis(double origin, double direction) {
    const auto f = static_cast<float>(origin);
    const float error = std::fabs(f) * 1.2e-7f + 1e-37f;
    auto d = static_cast<float>(direction);
    if (std::fabs(d) < kFlattest) d = std::signbit(d) ? -kFlattest : kFlattest;
    is_downward = d < 0;
    const float inverse = 1 / d;
    near_inverse = inverse * (1 - kSlack);
    far_inverse = inverse * (1 + kSlack);
    near_origin = is_downward ? f - error : f + error;
    far_origin = is_downward ? f + error : f - error;
  }
  float near_inverse, far_inverse, near_origin, far_origin;
  bool is_downward;
};

struct CullingRay {
  CullingRay() = default;
  explicit CullingRay(const Ray& ray) {
    for (std::size_t a = 0; a < 3; ++a) {
      set(a, CullingAxis(ray.origin[static_cast<int>(a)], ray.direction[static_cast<int>(a)]));
    }
  }
  void set(std::size_t a, const CullingAxis& axis) {
    near_inverse[a] = axis.near_inverse;
    far_inverse[a] = axis.far_inverse;
    near_origin[a] = axis.near_origin;
    far_origin[a] = axis.far_origin;
    near_side[a] = axis.is_downward ? 1 : 0;
  }
  std::array<float, 3> near_inverse, far_inverse, near_origin, far_origin;
  /// Index into a node's planes of the side that the ray meets first.
  std::array<std::size_t, 3> near_side;
};

}  // namespace graycube
