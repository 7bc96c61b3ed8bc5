// STL files, binary and ASCII.
#pragma once

#include <string_view>
#include <variant>

#include "mesh/close_mesh.hpp"

namespace graycube {

/// Facets' normals are ignored, the order of their corners counts. The digits are those of the
/// number that is written with most, seven in binary files. Faults of ASCII files begin with
/// "line N: ".
std::variant<PolygonMesh, MeshFault> read_stl(std::string_view bytes);

}  // namespace graycube
