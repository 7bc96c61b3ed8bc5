// Rotations out of matrices that were written with few digits.
#pragma once

#include <cstdint>

#include "geometry/affine.hpp"

namespace graycube {

/// The map that a matrix stands for whose entries were rounded to so many significant digits (1 to
/// 17): where its linear part can be the rounding of a rotation times a factor, with or without a
/// mirror, it is one, orthogonal to within some 1e-15; any other map, and one of a single number a
/// row and column, is as it was written. Translations always are.
///
/// Of all rotations that are written like that the one by round angles is taken: by x, then y, then
/// z, or about an axis of whole numbers, in thousandths of a degree or in parts of a full turn
/// (down to 1/64). Without one: where an entry is written 0, the product of two turns that keeps it
/// 0; else the nearest rotation. Deterministic on every machine.
Affine recovered_rotation(const Affine& written, std::uint32_t digits);

}  // namespace graycube
