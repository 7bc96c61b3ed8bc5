// Files that hold nothing but meshes: STL and OFF, and others through a library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formats/mesh/close_parts.hpp"
#include "formats/mesh/mesh_parts.hpp"
#include "mesh/close_mesh.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline constexpr std::uint64_t kMaxMeshFileBytes = std::uint64_t{1} << 30;

/// The mesh in a file as a mesh leaf of a scene names it, with its digits, or why there is none.
using MeshLoader = std::function<std::variant<MeshShape, MeshFault>(std::string_view file)>;

/// Reads the meshes of a file that is neither STL nor OFF (is_foreign_mesh_file).
using ForeignMeshReader =
    std::function<std::variant<std::vector<MeshPart>, MeshFault>(const std::filesystem::path&)>;

struct MeshReading {
  OpenMeshes open = OpenMeshes::kLeaveOut;
  /// May be empty: then foreign files are refused.
  ForeignMeshReader foreign{};
};

/// Opens files relative to the folder of `scene_file`. All solids of a file are one mesh. Warnings
/// of files, whose names are put before their places, are added to `warnings`, which must live as
/// long as the loader, if it isn't null.
MeshLoader mesh_files_beside(const std::filesystem::path& scene_file, MeshReading how = {},
                             std::vector<ImportWarning>* warnings = nullptr);

/// Whether the name has the ending of a mesh file, in either case.
bool is_mesh_file(const std::filesystem::path& path);
/// Whether it is a mesh file other than .stl and .off.
bool is_foreign_mesh_file(const std::filesystem::path& path);

/// The endings of mesh files, as text: ".stl, .off, …".
std::string mesh_endings_text();

/// Reads the file, by its name's ending. A file with several meshes gives a solid each; an STL file
/// gives one if all of its solids are closed together. Faults begin with the file's path.
std::variant<MeshSolids, MeshFault> read_mesh_file(const std::filesystem::path& path,
                                                   const MeshReading& how = {});

}  // namespace graycube
