#pragma once

#include <optional>

#include "csg/primitive.hpp"

namespace graycube {

struct BoundingSphere {
  Vec3 center;
  double radius;
};

/// A sphere around a bounded primitive: its own for a sphere, else the one through the corners of
/// its bounding box. Nothing for unbounded ones.
inline std::optional<BoundingSphere> bounding_sphere(const Primitive& p) {
  if (p.kind == PrimitiveKind::kSphere) return BoundingSphere{{p.v[0], p.v[1], p.v[2]}, p.v[3]};
  if (!p.bounds.is_finite()) return std::nullopt;
  return BoundingSphere{p.bounds.center(), 0.5 * length(p.bounds.hi - p.bounds.lo)};
}

}  // namespace graycube
