// Rotations out of matrices that were written with few digits.
#pragma once

#include <cstdint>

#include "geometry/affine.hpp"

namespace graycube {

/// The map behind a matrix whose entries were rounded to `digits` significant digits (1 to 17). If
/// its linear part can be the rounding of a rotation times a factor, with or without a mirror, it
/// becomes one, orthogonal to within some 1e-15. Any other map, and one with a single number in
/// each row and column, stays as written. Translations always do.
///
/// Of all rotations that are written so, the one by round angles is taken: by x, then y, then z, or
/// about an axis of whole numbers, in thousandths of a degree or in parts of a full turn (down to
/// 1/64). If there is none: when an entry is written 0, the product of two turns that keeps it 0;
/// else the nearest rotation. The result is the same on every machine.
Affine recovered_rotation(const Affine& written, std::uint32_t digits);

}  // namespace graycube
