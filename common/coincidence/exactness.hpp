// How exactly the surfaces of a primitive are known. The numbers of a file are rounded, and every
// map that carries them into the world rounds again, by a share of the largest numbers on the way.
// Surfaces closer together than that are taken to be the same (coincidence/coincidence.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/affine.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// The relative error that a double may have: 64 halves of its last place. A map of nested
/// transforms and a point under it take some four of these a level at the very worst; the rest is
/// for the program that computed the numbers of the file.
inline constexpr double kRoundedShare = 64 * 0x1p-53;

/// The decimal digits of a double; a larger number of digits is taken as this.
inline constexpr std::uint32_t kDoubleDigits = 17;

/// The relative error that a number of that many significant decimal digits may have: half a unit
/// of the last digit at worst, but at least kRoundedShare. 0 digits means all that a double has.
double share_of_digits(std::uint32_t digits);

/// A map composed of others, and the numbers by which its rounding errors are measured.
struct MeasuredMap {
  Affine map;
  /// The product of the absolute values of the maps' entries.
  Affine magnitude;
  /// The factor by which normals under the map are known worse than its entries.
  double turn = 1;
  /// Nothing is composed yet.
  bool is_identity = true;
};
/// The same map; how far it moves what is under it is measured as if known to `share` where it is
/// known to `map_share`: since it moves everything alike, nothing comes apart by its rounding.
MeasuredMap moving_all_alike(MeasuredMap map, double share, double map_share);
/// The map that applies `first`, then `then`.
MeasuredMap compose(const MeasuredMap& then, const Affine& first);

/// Floats, since there is one for each primitive.
struct Exactness {
  /// How far off points of the surface may be along each axis of the world.
  std::array<float, 3> along{};
  /// How far off a plane's normal may be, in radians.
  float direction = 0;

  Vec3 position() const { return {along[0], along[1], along[2]}; }
  /// How far off points may be along the axis on which they are known worst.
  double distance() const { return std::max(along[0], std::max(along[1], along[2])); }
};

/// The exactness of a shape whose points have local coordinates of at most `reach` along each axis,
/// and whose directions are known `turn` ≥ 1 times worse than its numbers, to a `share` of these.
/// How far the map moves it is known to `map_share` ≤ share.
Exactness exactness_of(const MeasuredMap& map, const Vec3& reach, double turn, double share,
                       double map_share);

}  // namespace graycube
