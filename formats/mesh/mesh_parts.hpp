// What a mesh file holds: one mesh, or several, each with what the file says of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/close_mesh.hpp"

namespace graycube {

struct MeshPart {
  std::string name{};  ///< Empty if the file gives none.
  PolygonMesh polygons{};
  /// Red, green, blue and alpha in sRGB, 0 … 1.
  std::optional<std::array<double, 4>> color{};
};

/// The most parts of a file; each becomes an object.
inline constexpr std::size_t kMaxMeshParts = 1u << 16;
/// Longer names are cut off.
inline constexpr std::size_t kMaxMeshNameBytes = 256;

/// A file's name for a part as text in UTF-8: bytes that are none become '?', control characters
/// spaces, and what is too long is cut off.
std::string mesh_name(std::string_view bytes);

/// All parts as one mesh, their points and faces in order; its digits are the most that a part has.
PolygonMesh united(std::vector<MeshPart> parts);

}  // namespace graycube
