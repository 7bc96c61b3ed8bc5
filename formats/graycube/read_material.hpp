#pragma once

#include "formats/json/access.hpp"
#include "shading/material.hpp"

namespace graycube {

void read_material(JsonAccess& json, JsonIndex at, Material& out);

}  // namespace graycube
