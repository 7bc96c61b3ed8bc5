// polyhedron(), whose faces may be bent, double or open.
#pragma once

#include <cstdint>
#include <optional>

#include "formats/openscad/primitives.hpp"

namespace graycube {

/// The solid; nothing, with a warning, when its faces enclose none. `digits` are those of the
/// file's numbers.
std::optional<ScadSolid> polyhedron(ScadArguments& arguments, std::uint32_t digits);

}  // namespace graycube
