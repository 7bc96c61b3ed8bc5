// STL files, binary and ASCII.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"

namespace graycube {

/// A part for each `solid` of an ASCII file, or the one mesh of a binary file; at least one.
/// Facets' normals are ignored, the order of their corners counts. The digits are those of the
/// number that is written with most, seven in binary files.
///
/// A binary file whose size is that of whole facets holds as many as fit, whatever number its
/// header gives: programs that write as they go leave it 0. ASCII files are read as programs write
/// them: in either case, without normals, with comments after '#', ';' or '//', with facets of more
/// than three corners. Faults of ASCII files begin with "line N: ".
std::variant<std::vector<MeshPart>, MeshFault> read_stl(std::string_view bytes);

}  // namespace graycube
