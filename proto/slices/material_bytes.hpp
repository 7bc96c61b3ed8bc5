// A material's record in a model slice: FORMAT.md, "Material".
#pragma once

#include <cstddef>

#include "proto/bytes.hpp"
#include "shading/material.hpp"

namespace graycube {

std::size_t material_bytes(const Material& m);
void put_material(ByteWriter& w, const Material& m);
/// What is wrong with the record, or nullptr.
const char* get_material(ByteReader& r, Material& m);

}  // namespace graycube
