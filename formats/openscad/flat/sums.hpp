// minkowski() of flat shapes with what is round exact, where that has a form in disks and polygons.
#pragma once

#include "formats/openscad/flat/rounds.hpp"

namespace graycube {

/// Exact for two convex shapes, for any polygon and a convex shape, for a circle and what
/// exact_offset grows, and for unions of these.
ExactFlat exact_flat_sum(const FlatShape& a, const FlatShape& b);

}  // namespace graycube
