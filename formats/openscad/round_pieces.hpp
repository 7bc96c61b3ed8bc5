// Modules of a .csg file as hulls of balls, discs and points, each under a map of its own.
#pragma once

#include <optional>
#include <vector>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hulls/round_hull.hpp"

namespace graycube {

struct RoundItem {
  enum class Kind : std::uint8_t { kPoint, kBall, kDisc };
  Kind kind = Kind::kPoint;
  /// The ball, disc or point before the map, where discs are level. A point's radius is 0.
  RoundPoint round;
  Affine map;
};
/// A convex solid: the hull of its items.
using RoundPiece = std::vector<RoundItem>;

/// Whether solids have to be convex, or only their hulls count.
enum class PieceUse : std::uint8_t { kHull, kConvex };

/// Most convex solids that a Minkowski sum is made of, and most sums of their items before hidden
/// ones are left out.
inline constexpr std::size_t kMaxSumPieces = 64;
inline constexpr std::size_t kMaxSumItems = std::size_t{1} << 14;

/// Appends the pieces whose union, or hull, is the module's. False if the module isn't known to be
/// one, or is beyond the limits.
bool add_pieces(const ScadModule& module, const Affine& map, PieceUse use, ScadImport& import,
                std::vector<RoundPiece>& pieces);

/// The items as seen from a frame without translation, in which balls are balls and discs level
/// discs.
struct FramedPiece {
  Affine frame;
  /// One point for each item, in their order.
  std::vector<RoundPoint> points;
  bool has_balls = false, has_discs = false;
};
/// The items in a frame that is the identity or the linear part of the first map of something
/// round; nothing if neither suits.
std::optional<FramedPiece> framed(const RoundPiece& items);

/// The Minkowski sum of convex solids; nothing if one has balls and the other discs, or if no frame
/// suits both.
std::optional<RoundPiece> sum_of(const RoundPiece& a, const RoundPiece& b);

}  // namespace graycube
