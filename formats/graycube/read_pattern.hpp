#pragma once

#include "formats/json/access.hpp"
#include "shading/pattern.hpp"

namespace graycube {

/// Reads a material's pattern; keys that its type doesn't have are errors.
void read_pattern(JsonAccess& json, JsonIndex at, Pattern& out);

}  // namespace graycube
