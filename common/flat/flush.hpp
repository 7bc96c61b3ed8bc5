// Operations on figures whose corners and sides came to the same place by different arithmetic, or
// with few digits.
#pragma once

#include <cstdint>
#include <span>

#include "flat/polygon.hpp"

namespace graycube {

/// How far apart corners and sides may be that are meant to be in one place: less than a unit in
/// the last of so many digits of the largest coordinate, a quarter of the shortest side at most,
/// and in any case some steps of Clipper's grid (4 · 10⁻¹² to 8 · 10⁻¹² of the largest coordinate).
double flush_tolerance(std::span<const FlatLoops> operands, std::uint32_t digits);

/// As combined(), with corners that are within the tolerance of one another in one place, that of
/// the first by x, then y; and sides that pass a corner within it bent to go through it: so what is
/// flush leaves no slivers, nor gaps. Where neither turns into a corner of the result, sides are
/// straight again. Independent of the operands' order but for what the operation makes of it.
/// crossings_are_few() bounds its time, too.
FlatLoops combined_flush(FlatOperation operation, std::span<const FlatLoops> operands,
                         double tolerance);

}  // namespace graycube
