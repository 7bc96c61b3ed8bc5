// Pairs of scenes that hold the same solids. One has faces that touch: flush cuts, plugs, nested
// shells, each part told in its own numbers and brought there by its own maps. In the other no
// surface coincides with another.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace graycube::testing {

enum class PairKind : std::uint8_t {
  kThroughHoles,    ///< cuts as long as their plate
  kPocketToTop,     ///< a cut from the inside up to the top
  kNotch,           ///< a box cut from an edge or a corner, flush with three or four faces
  kStandingBoss,    ///< a boss on its flange, against one sunk into it
  kPlug,            ///< a hole filled by its own solid
  kSunkPlug,        ///< a blind hole filled by its own solid, as a countersink by its screw
  kBoreAndBoss,     ///< a bore below a boss of the same sides
  kDrilledBoss,     ///< a boss drilled away by a bore of its sides
  kShells,          ///< balls or ellipsoids in one another, two of one size
  kTubes,           ///< columns in one another, two of one size
  kGroove,          ///< a ring's groove filled by the ring
  kSplitAndJoined,  ///< (X − Y) ∪ (X ∩ Y)
  kUnionLess,       ///< (X ∪ Y) − Y
  kFlushBox,        ///< a plate within a box as high
  kComplements,     ///< through holes, by complements and a union
  kSlices,          ///< a column in three slices
  kAssembly,        ///< several of these as objects, or as one
};
inline constexpr std::size_t kPairKinds = 17;
inline constexpr std::array<const char*, kPairKinds> kPairNames{
    "through holes", "pocket to the top", "notch",        "standing boss", "plug",
    "sunk plug",     "bore and boss",     "drilled boss", "shells",        "tubes",
    "groove",        "split and joined",  "union less",   "flush box",     "complements",
    "slices",        "assembly"};

/// A place where surfaces touch, in coordinates of the part.
struct Site {
  Affine to_world;
  /// The part lies within this radius about the z axis, between 0 and `height`.
  double radius = 0, height = 0;
  /// Discs in which faces touch or parts lie: x, y, radius.
  std::vector<Vec3> discs;
  /// Heights at which faces lie.
  std::vector<double> heights;

  /// The largest stretch of its world map times its radius.
  double world_size() const {
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      Vec3 e;
      e[i] = 1;
      longest = std::fmax(longest, length(to_world.vector(e)));
    }
    return longest * std::fmax(radius, height);
  }
};

struct FlushPair {
  std::uint64_t seed = 0;
  PairKind kind{};
  Scene flush, longer;
  std::vector<Site> sites;
  /// How far the maps of the parts' ways differ, in units in the last place of the largest
  /// coordinate.
  double ways_differ_ulps = 0;

  std::string text() const {
    return std::string(kPairNames[static_cast<std::size_t>(kind)]) + ", seed " +
           std::to_string(seed);
  }
};

}  // namespace graycube::testing
