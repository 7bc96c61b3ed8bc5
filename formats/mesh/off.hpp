// OFF files, text and binary.
#pragma once

#include <string_view>
#include <variant>

#include "mesh/close_mesh.hpp"

namespace graycube {

/// Files that begin with OFF, and those that announce more in front of it (ST texture coordinates,
/// C colours, N normals, 4 a fourth coordinate by which the others are divided, n the number of
/// dimensions, which must be 3) or "OFF BINARY" (big-endian, as Geomview and CGAL write it). What a
/// point has beyond its place, and colours of faces, are skipped, and so are faces of one or two
/// corners. Words may be on any lines: where each point or face has a line, what else is on it is
/// skipped, announced or not.
///
/// The digits are those of the number that is written with most, seven in binary files. Faults of
/// texts begin with "line N: ".
std::variant<PolygonMesh, MeshFault> read_off(std::string_view bytes);

}  // namespace graycube
