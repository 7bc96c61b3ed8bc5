// The rule by which boundaries between macro-regions slide while a picture is rendered (Nemoto &
// Omachi 1986): from a part with much left to do towards a neighbour with little.
#pragma once

#include "regions/rectilinear.hpp"

namespace graycube {

struct SlideRules {
  /// A boundary slides if the heaviest part on one side has more than so many times as much left
  /// to do as the heaviest on the other.
  double least_ratio = 1.25;
  /// It slides by at most this part of the narrower side, or by one cell, if that is more.
  double most_part = 0.25;
};

/// The work that is left: of cells, which goes with them to another part; and of parts, one entry
/// for each, which stays where it is.
struct WorkLeft {
  LoadMap cells, parts;
};

/// Slides each of the cuts where that lightens the heavier of its two sides, columns first, each by
/// as much as the rules allow and lightens it most. Every part keeps a cell.
RectilinearCuts slid_cuts(const WorkLeft& left, const RectilinearCuts& now,
                          const SlideRules& rules);

}  // namespace graycube
