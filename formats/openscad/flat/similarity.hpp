// Maps of the plane that keep circles round.
#pragma once

#include <cmath>
#include <optional>

#include "flat/polygon.hpp"

namespace graycube {

/// The rounding error that some hundred rotations inside one another may have.
inline constexpr double kRotationPrecision = 1e-13;

/// The factor of a similarity, to within rounding; nothing for any other map.
inline std::optional<double> similarity_scale(const FlatMap& map) {
  const double a = map.m[0][0], b = map.m[0][1], c = map.m[1][0], d = map.m[1][1];
  const double first = std::sqrt(a * a + c * c), second = std::sqrt(b * b + d * d);
  const double scale = 0.5 * (first + second);
  if (!(std::fabs(first - second) <= 2 * kRotationPrecision * scale)) return std::nullopt;
  if (!(std::fabs(a * b + c * d) <= kRotationPrecision * scale * scale)) return std::nullopt;
  return scale;
}

}  // namespace graycube
