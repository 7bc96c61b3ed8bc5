// Affine maps p' = M p + t, stored as three rows of four.
#pragma once

#include <array>
#include <optional>

#include "geometry/vec.hpp"

namespace graycube {

struct Affine {
  /// Row-major; column 3 is the translation. Default: the identity.
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  constexpr Vec3 point(const Vec3& p) const {
    return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
            m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
            m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
  }
  constexpr Vec3 vector(const Vec3& v) const {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
            m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }
  /// Mᵀ v: takes a normal of the image space of the inverse back, see `Affine::inverse`.
  constexpr Vec3 transposed_vector(const Vec3& v) const {
    return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z,
            m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
            m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
  }
  constexpr Vec3 row(int i) const {
    const auto r = static_cast<std::size_t>(i);
    return {m[r][0], m[r][1], m[r][2]};
  }
  constexpr Vec3 translation() const { return {m[0][3], m[1][3], m[2][3]}; }

  /// Determinant of the linear part.
  double determinant() const;
  /// The inverse map, or nothing when it leaves the range of doubles, or when the linear part is
  /// singular or so ill-conditioned (determinant below 1e-12 times the product of the row lengths)
  /// that no digit of it would be right. Factors of whole columns don't count as ill conditions.
  std::optional<Affine> inverse() const;
  /// The factor by which every length grows, when the map is a similarity to within rounding
  /// (columns orthogonal and of one length to 1e-14 relative); nothing otherwise.
  std::optional<double> similarity_scale() const;
  bool is_finite() const;

  friend constexpr bool operator==(const Affine&, const Affine&) = default;
};

/// The map that applies `first`, then `then`.
Affine compose(const Affine& then, const Affine& first);

Affine translation(const Vec3& offset);
Affine scaling(const Vec3& factors);
/// Rotation about the origin by the right-hand rule; `axis` need not be unit, but not zero.
/// Multiples of 90° are exact, so that rotated boxes stay axis-aligned.
Affine rotation(const Vec3& axis, double angle_degrees);

}  // namespace graycube
