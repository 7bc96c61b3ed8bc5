// Operations on figures whose corners and sides came to nearly the same place, by different
// arithmetic or with few digits.
#pragma once

#include <cstdint>
#include <span>

#include "flat/polygon.hpp"

namespace graycube {

/// The distance up to which corners and sides count as in one place: less than a unit in the last
/// of `digits` digits of the largest coordinate, at most a quarter of the shortest side, but at
/// least some steps of Clipper's grid (4 · 10⁻¹² to 8 · 10⁻¹² of the largest coordinate).
double flush_tolerance(std::span<const FlatLoops> operands, std::uint32_t digits);

/// Like combined(), but first moves corners within the tolerance of one another to one place, that
/// of the first by x, then y, and bends sides that pass a corner within the tolerance to go through
/// it: so flush figures leave no slivers or gaps. Sides become straight again where no corner of
/// the result comes of that. The operands' order matters only if it does to the operation.
/// crossings_are_few() bounds the time of this, too.
FlatLoops combined_flush(FlatOperation operation, std::span<const FlatLoops> operands,
                         double tolerance);

}  // namespace graycube
