// Mesh files that the library assimp reads.
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"

namespace graycube {

/// A part for each use of a mesh in the file, where the file's nodes move it to, with the colour of
/// its material. Coordinates are the file's own numbers, of 24 bits, in formats in which z is up or
/// nothing is said of it; where a format says that y is up (glTF, Collada, X3D), the model is
/// turned about x, so that z is. Lines and points are skipped.
///
/// The library is not made for hostile files: it may crash or take any memory, so this runs in a
/// process of its own.
std::variant<std::vector<MeshPart>, MeshFault> read_by_assimp(const std::filesystem::path& path);

}  // namespace graycube
