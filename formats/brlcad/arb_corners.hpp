// The corners of BRL-CAD's arbs, and the faces between them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "formats/brlcad/solid_nodes.hpp"
#include "geometry/aabb.hpp"

namespace graycube::brlcad {

/// The corners of a face, in order around it.
using ArbFace = std::array<std::size_t, 4>;
inline constexpr std::array<ArbFace, 6> kArbFaces{
    {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};

struct ArbCorners {
  std::array<Vec3, 8> at;
  Vec3 center;
  /// The diagonal of their bounds.
  double size = 0;

  explicit ArbCorners(const Values& p) {
    Aabb box = Aabb::nothing();
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] = p.point(i);
      box.include(at[i]);
      center = center + 0.125 * at[i];
    }
    size = length(box.hi - box.lo);
  }

  /// A face's corners without those that are as good as equal to one before.
  std::vector<Vec3> distinct(const ArbFace& face) const {
    std::vector<Vec3> out;
    for (const std::size_t i : face) {
      const bool is_new = std::none_of(out.begin(), out.end(),
                                       [&](const Vec3& q) { return is_zero(q - at[i], size); });
      if (is_new) out.push_back(at[i]);
    }
    return out;
  }
};

}  // namespace graycube::brlcad
