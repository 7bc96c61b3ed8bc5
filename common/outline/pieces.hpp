// Cuts the segments of outlines where they turn back in x or in y.
#pragma once

#include <vector>

#include "outline/cubic.hpp"

namespace graycube {

struct OutlinePoint {
  double x = 0, y = 0;
  friend bool operator==(const OutlinePoint&, const OutlinePoint&) = default;
};
struct OutlineBox {
  OutlinePoint lo, hi;
};
/// A closed cycle of cubic Bézier segments, three points each: where segment i begins, and its two
/// inner control points; it ends where segment i + 1 begins, the last where the first begins.
using OutlineLoop = std::vector<OutlinePoint>;
using OutlineLoops = std::vector<OutlineLoop>;

/// A part of a segment, monotonic in x and in y up to rounding. Neighbours share their ends to the
/// bit.
struct OutlinePiece {
  Cubic x, y;

  OutlinePoint at(double v) const { return {x.at(v), y.at(v)}; }
  /// A vector along the curve, of no particular length; (0, 0) only if the piece is a point.
  OutlinePoint tangent(double v) const;
  /// Around the ends, and so around the piece.
  OutlineBox box() const;
};

/// The pieces of all loops, in order.
std::vector<OutlinePiece> pieces_of(const OutlineLoops& loops);

}  // namespace graycube
