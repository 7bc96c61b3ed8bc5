// How exactly the surfaces of a primitive are known. The numbers of a file are rounded, and every
// map that carries them into the world rounds again, by a share of the largest numbers on the way.
// What lies closer together than that was one in the model (coincidence/coincidence.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/affine.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// What a double may be off by, as a share: 64 halves of its last place. A map of nested transforms
/// and a point under it take some four a level at the very worst; the rest is for whoever computed
/// the numbers of the file.
inline constexpr double kRoundedShare = 64 * 0x1p-53;

/// Digits of a double; more are taken as so many.
inline constexpr std::uint32_t kDoubleDigits = 17;

/// What a number of so many significant decimal digits may be off by, as a share: half a unit of
/// the last one at worst, but kRoundedShare at least. 0 digits: all that a double has.
double share_of_digits(std::uint32_t digits);

/// A map made of others, and what its rounding errors are measured against.
struct MeasuredMap {
  Affine map;
  /// The product of the absolute values of the maps' entries.
  Affine magnitude;
  /// How many times worse the directions of normals are known under it than its entries.
  double turn = 1;
  /// Nothing is composed yet.
  bool is_identity = true;
};
/// The map that applies `first`, then `then`.
MeasuredMap compose(const MeasuredMap& then, const Affine& first);

/// Floats, since there is one for each primitive.
struct Exactness {
  /// How far off points of the surface may be along each axis of the world.
  std::array<float, 3> along{};
  /// How far off a plane's normal may be, in radians.
  float direction = 0;

  Vec3 position() const { return {along[0], along[1], along[2]}; }
  /// How far off points may be in any direction, along one axis.
  double distance() const { return std::max(along[0], std::max(along[1], along[2])); }
};

/// Of a shape whose points have local coordinates of at most `reach` along each axis, and whose
/// directions are known `turn` ≥ 1 times worse than their numbers.
Exactness exactness_of(const MeasuredMap& map, const Vec3& reach, double turn, double share);

}  // namespace graycube
