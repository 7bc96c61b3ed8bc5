// The boxes and spheres around a CSG tree's leaves and inner nodes (Roth 1982).
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "crossings/mailbox.hpp"
#include "csg/bounding_sphere.hpp"
#include "csg/model.hpp"
#include "geometry/ray.hpp"

namespace graycube {

/// A ray with the reciprocals of its direction and what rounding may amount to.
struct BoundingRay {
  explicit BoundingRay(const Ray& r)
      : ray(r),
        inverse{1 / r.direction.x, 1 / r.direction.y, 1 / r.direction.z},
        inverse_square(1 / dot(r.direction, r.direction)),
        error(kRelativeError * max_abs(r.origin)) {}
  /// Far larger than the relative rounding error of a few sums and products.
  static constexpr double kRelativeError = 1e-12;

  const Ray& ray;
  Vec3 inverse;
  double inverse_square;
  double error;
};

/// Outside of both volumes all of space is in the node's solid, or none of it: a complement's
/// volumes are those of what it is the complement of. Infinite where neither is bounded.
struct BoundingVolumes {
  Aabb box;
  BoundingSphere sphere{{}, kInf};
  bool is_inside_beyond = false;

  /// Whether the line surely misses the sphere. Its point nearest the centre is found from the
  /// origin, and is wrong by the rounding errors of that distance at most.
  bool misses_sphere(const BoundingRay& r) const {
    const Vec3 to_origin = r.ray.origin - sphere.center;
    const double along = dot(to_origin, r.ray.direction) * r.inverse_square;
    const Vec3 nearest = to_origin - along * r.ray.direction;
    const double reach = sphere.radius + r.error + BoundingRay::kRelativeError * max_abs(to_origin);
    return dot(nearest, nearest) > reach * reach * (1 + BoundingRay::kRelativeError);
  }
  /// Whether the line surely isn't in the box at t0 ≤ t < t1.
  bool misses_box(const BoundingRay& r, double t0, double t1) const {
    for (int a = 0; a < 3; ++a) {
      const double lo = (box.lo[a] - r.error - r.ray.origin[a]) * r.inverse[a];
      const double hi = (box.hi[a] + r.error - r.ray.origin[a]) * r.inverse[a];
      // Written so that a NaN, which a line in a face's plane gives, is ignored.
      const double enter = r.inverse[a] > 0 ? lo : hi;
      const double leave = r.inverse[a] > 0 ? hi : lo;
      if (enter > t0) t0 = enter;
      if (leave < t1) t1 = leave;
    }
    return t0 > t1 + BoundingRay::kRelativeError * std::fabs(t1);
  }
  /// Whether no surface of the node is crossed at t0 ≤ t < t1; the volumes tested are counted.
  bool are_missed(const BoundingRay& r, double t0, double t1, WalkCounts& counts) const {
    if (std::isfinite(sphere.radius)) {
      ++counts.spheres_tested;
      if (misses_sphere(r)) {
        ++counts.spheres_rejected;
        return true;
      }
    }
    if (box == Aabb::everything()) return false;
    ++counts.boxes_tested;
    if (!misses_box(r, t0, t1)) return false;
    ++counts.boxes_rejected;
    return true;
  }
};

/// For each node of Model::nodes, by the same index; grown by the model's delta.
std::vector<BoundingVolumes> bounding_volumes_of(const Model& model);

}  // namespace graycube
