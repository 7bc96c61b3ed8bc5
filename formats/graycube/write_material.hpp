#pragma once

#include "formats/graycube/json_text.hpp"
#include "shading/material.hpp"

namespace graycube {

/// Writes a material as the value of a member, as read_material() reads it.
void write_material(JsonText& json, const Material& material);

}  // namespace graycube
