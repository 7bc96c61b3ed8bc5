#pragma once

#include <optional>

#include "csg/sphere.hpp"

namespace graycube {

struct BoundingSphere {
  Vec3 center;
  double radius;
};

/// A sphere around a bounded primitive: its own for a sphere, else the one through the corners of
/// its bounding box. Nothing for unbounded ones.
inline std::optional<BoundingSphere> bounding_sphere(const Primitive& p) {
  if (p.kind == PrimitiveKind::kSphere) {
    return BoundingSphere{csg::sphere_center(p.v), csg::sphere_radius(p.v)};
  }
  if (!p.bounds.is_finite()) return std::nullopt;
  return BoundingSphere{p.bounds.center(), 0.5 * length(p.bounds.hi - p.bounds.lo)};
}

}  // namespace graycube
