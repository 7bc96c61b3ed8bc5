// Hulls of balls and level discs together, in which the discs are ends of columns: such as rounded
// below and flat on top.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/openscad/hulls/round_solid.hpp"

namespace graycube {

struct BallOrDisc {
  RoundPoint round;
  bool is_disc = false;
};

/// The hull, computed as that of balls in the discs' places, cut off where discs are highest or
/// lowest. Nothing if that isn't the same. It is the same when (1) no ball or disc reaches sideways
/// out of the hull of the discs at a cut, and (2) the half of a disc's ball that isn't cut off
/// belongs to the hull already, because a ball stands below (or above), or a disc further away than
/// its radius. Proof: an extreme point of the hull of the balls within the cuts is one of a ball,
/// and so in the hull by (2), or lies in a cut, and so within the discs there by (1).
std::optional<RoundSolid> capped_solid(std::span<const BallOrDisc> items, bool& is_too_large);

}  // namespace graycube
