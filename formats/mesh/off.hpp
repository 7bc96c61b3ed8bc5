// OFF files.
#pragma once

#include <string_view>
#include <variant>

#include "mesh/close_mesh.hpp"

namespace graycube {

/// OFF with `OFF` at its start; comments and colours of faces are skipped. The digits are those of
/// the number that is written with most. Faults begin with "line N: ".
std::variant<PolygonMesh, MeshFault> read_off(std::string_view text);

}  // namespace graycube
