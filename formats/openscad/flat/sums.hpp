// minkowski() of flat shapes with round parts exact, if the sum has a form in disks and polygons.
#pragma once

#include "formats/openscad/flat/rounds.hpp"

namespace graycube {

/// Exact for two convex shapes, for any polygon and a convex shape, for a circle and a shape that
/// exact_offset can grow, and for unions of these.
ExactFlat exact_flat_sum(const FlatShape& a, const FlatShape& b);

}  // namespace graycube
