// Whether flat shapes touch: growing and shrinking distribute over operations only where they
// don't.
#pragma once

#include <span>

#include "formats/openscad/flat/shape.hpp"

namespace graycube {

/// Whether no two of the shapes come near one another. "Near" is what facets of 256 a circle can't
/// tell.
bool are_apart(std::span<const FlatShape> shapes);

/// Whether all shapes lie within the first, and near its outline nowhere.
bool are_within_first(std::span<const FlatShape> shapes);

}  // namespace graycube
