// Reads mesh files that are neither STL nor OFF, by the program graycube-meshes.
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"

namespace graycube {

/// The program beside this command; it is there if it was built, which takes the library assimp.
std::filesystem::path mesh_reader_program();

/// The meshes of the file as the program reads them. Faults: a file that isn't there or is larger
/// than kMaxMeshFileBytes; no program; what the program tells, or the signal that ended it.
std::variant<std::vector<MeshPart>, MeshFault> read_foreign_meshes(
    const std::filesystem::path& file, const std::filesystem::path& program);

}  // namespace graycube
