// Files that hold one mesh: STL, binary and ASCII, and OFF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <variant>

#include "mesh/close_mesh.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t{1} << 30;

/// The mesh in a file as a mesh leaf of a scene names it, with its digits, or why there is none.
using MeshLoader = std::function<std::variant<MeshShape, MeshFault>(std::string_view file)>;

/// Opens files relative to the folder of `scene_file`.
MeshLoader mesh_files_beside(const std::filesystem::path& scene_file);

/// Whether the name ends in .stl or .off, in either case.
bool is_mesh_file(const std::filesystem::path& path);

/// Reads the file, by its name's ending.
std::variant<MeshShape, MeshFault> read_mesh_file(const std::filesystem::path& path);

}  // namespace graycube
