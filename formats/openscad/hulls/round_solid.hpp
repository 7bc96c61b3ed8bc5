// The hull of balls, or of level discs, and points as a union of exact primitives: spheres, cones
// and cylinders between pairs of them, and one polyhedron.
#pragma once

#include <optional>
#include <vector>

#include "formats/openscad/hulls/round_hull.hpp"

namespace graycube {

struct RoundSolid {
  CsgNode node;
  /// The corners of the solid's polyhedron.
  std::vector<Vec3> corners;
};

/// Pieces overlap, and planes that they share are tangent where they meet. Nothing for a hull
/// without volume, and beyond round_hull's limits, which sets `is_too_large`.
std::optional<RoundSolid> round_solid(RoundKind kind, std::vector<RoundPoint> points,
                                      bool& is_too_large);

}  // namespace graycube
