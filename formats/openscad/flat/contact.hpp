// Whether flat shapes touch: growing and shrinking distribute over operations only if they
// don't.
#pragma once

#include <span>

#include "formats/openscad/flat/shape.hpp"

namespace graycube {

/// Whether no two of the shapes come near one another. "Near" is a distance that facets of 256 a
/// circle can't tell from 0.
bool are_apart(std::span<const FlatShape> shapes);

/// Whether all shapes lie within the first, and nowhere near its outline.
bool are_within_first(std::span<const FlatShape> shapes);

}  // namespace graycube
