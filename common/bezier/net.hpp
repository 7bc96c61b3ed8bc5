// Nets of bicubic Bézier patches, as values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/vec.hpp"

namespace graycube {

/// The most patches of a net.
inline constexpr std::uint32_t kMaxBezierPatches = 1u << 16;

/// Numbers of 16 control points, four rows of four: u goes along a row, v from row to row.
using BezierPatch = std::array<std::uint32_t, 16>;

struct BezierNet {
  std::vector<Vec3> points;
  std::vector<BezierPatch> patches;

  const Vec3& point(const BezierPatch& patch, std::size_t row, std::size_t column) const {
    return points[patch[4 * row + column]];
  }
  friend bool operator==(const BezierNet&, const BezierNet&) = default;
};

/// The point of a cubic Bézier curve at t, by de Casteljau's repeated interpolation.
inline Vec3 point_at(const std::array<Vec3, 4>& c, double t) {
  const auto between = [t](const Vec3& a, const Vec3& b) { return (1 - t) * a + t * b; };
  const Vec3 a = between(c[0], c[1]), b = between(c[1], c[2]), d = between(c[2], c[3]);
  return between(between(a, b), between(b, d));
}

/// The point of a patch at u and v.
inline Vec3 point_at(const BezierNet& net, const BezierPatch& patch, double u, double v) {
  std::array<Vec3, 4> across;
  for (std::size_t row = 0; row < 4; ++row) {
    across[row] = point_at({net.point(patch, row, 0), net.point(patch, row, 1),
                            net.point(patch, row, 2), net.point(patch, row, 3)},
                           u);
  }
  return point_at(across, v);
}

}  // namespace graycube
