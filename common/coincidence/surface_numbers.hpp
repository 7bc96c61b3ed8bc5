// Numbers by which curved surfaces are recognised, whatever frames they were given in: two
// primitives have the same surface if all of their numbers agree. A ball's frame may be turned any
// way, a cylinder's may be turned about its axis and moved along it, a cone's may begin anywhere on
// it; so the numbers describe symmetric forms, axes without a sense, and points that the surface
// determines.
#pragma once

#include "coincidence/clusters.hpp"
#include "coincidence/exactness.hpp"
#include "csg/primitive.hpp"

namespace graycube::csg {

/// Kinds whose surfaces may be the same are of one family.
enum class SurfaceFamily : std::uint8_t {
  kBall,
  kCylinder,
  kCone,
  kTorus,
  kEllipticTorus,
  kEllipticCone,
  kQuadric,
  kNone
};
inline constexpr std::size_t kSurfaceFamilies = 7;

SurfaceFamily family_of(const Primitive& p);
int number_count(SurfaceFamily family);
/// Number `which` of number_count, with its tolerance. Number 0 differs for nearly all surfaces
/// that differ, and is quick to compute.
Measured surface_number(const Primitive& p, const Exactness& exactness, int which);

}  // namespace graycube::csg
