// Round surfaces of Minkowski sums, as told by their corners.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "formats/openscad/hulls/round_ring.hpp"

namespace graycube {

/// The same round surface elsewhere.
RoundRing moved(RoundRing ring, const Vec3& by);

/// The round surface of the sum of two convex solids where its facets are told by a ring. Of a
/// cylinder and another round solid about the same direction that is a cylinder, around the corners
/// of both; of a cone and a ball with the same corners about the same axis it is the rim around the
/// cone's wide end, and of two balls with corners in the same directions a ball. Nothing for all
/// others. `origin`: where the sum's origin lies. `share`: how far coordinates may be off, relative
/// to their size.
std::optional<RoundRing> sum_of(const RoundRing& a, const RoundRing& b, const Vec3& origin,
                                double share);

/// What a sum is of: round solids, and the corners of what is straight. Where a sum of the former
/// is told by no ring it is missing.
struct SumOperand {
  std::vector<RoundRing> rings;
  std::vector<Vec3> corners;

  /// Corners of all.
  std::size_t size() const;
};

/// Most corners of an operand, and most pairs of corners of two.
inline constexpr std::size_t kMostSumCorners = std::size_t{1} << 17;

/// Adds an operand to a sum, which becomes what both are together; false if that is too much.
bool add_to_sum(SumOperand& sum, const SumOperand& operand, const Vec3& origin, double share);

}  // namespace graycube
