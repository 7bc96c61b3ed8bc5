// Makes solids of the meshes of a file: each that is closed, those that are closed together, and
// says which are left out.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"
#include "formats/report/import_warnings.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// A closed mesh, and what its file says of it, as MeshPart.
struct MeshSolid {
  std::string name{};
  MeshShape shape{};
  std::optional<std::array<double, 4>> color{};
};

struct MeshSolids {
  std::vector<MeshSolid> solids;
  /// What was repaired, and what was left out and why.
  std::vector<ImportWarning> warnings;
};

/// What becomes of meshes that are open, or enclose nothing: they are left out, repaired
/// (mesh/repair_mesh.hpp), or only rid of faces that are one too many
/// (formats/mesh/extra_faces.hpp), and left out where that doesn't close them.
enum class OpenMeshes { kLeaveOut, kRepair, kDropExtraFaces };

/// Solids of the parts, in their order, at least one. Parts that are open but share open edges, as
/// those of different colours of one body do, are one solid if they are closed together. Otherwise
/// `open` says what becomes of them. If all
/// are left out that is a fault.
std::variant<MeshSolids, MeshFault> closed_parts(std::vector<MeshPart> parts, OpenMeshes open);

/// The same with all parts taken for one body first, which they are where it is closed. One body
/// has no name.
std::variant<MeshSolids, MeshFault> closed_body(std::vector<MeshPart> parts, OpenMeshes open);

}  // namespace graycube
