// The points and paths of polygon().
#pragma once

#include "flat/polygon.hpp"
#include "formats/openscad/language/arguments.hpp"

namespace graycube {

/// The polygon's loops as they are written, perhaps with fewer than three corners; false, after a
/// warning, if it is left out.
bool read_polygon(const ScadModule& module, ScadArguments& arguments, FlatLoops& loops);

}  // namespace graycube
