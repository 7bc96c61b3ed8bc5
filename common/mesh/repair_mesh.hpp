// Closes meshes that are nearly closed: corners that should be one are joined, flat holes filled.
#pragma once

#include <cstddef>
#include <variant>

#include "mesh/close_mesh.hpp"
#include "mesh/triangle_mesh.hpp"

namespace graycube {

/// Corners are joined to close edges if they are no farther apart than this share of the longest
/// side of the mesh's bounds, and holes filled that are so flat.
inline constexpr double kRepairShare = 1e-4;
/// The most edges of a hole that is filled.
inline constexpr std::size_t kMaxFilledEdges = 64;

/// What was done to a mesh; all zero if it was closed.
struct MeshRepairs {
  std::size_t joined_corners = 0;
  double farthest_joined = 0;     ///< The largest difference of two joined corners' coordinates.
  std::size_t dropped_faces = 0;  ///< Triangles that were there twice.
  std::size_t filled_holes = 0, most_filled_edges = 0;
};

struct RepairedMesh {
  TriangleMesh mesh;
  MeshRepairs repairs;
};

/// Whether a closed mesh encloses more than next to nothing, beside its longest side's cube.
bool encloses_volume(const TriangleMesh& mesh);

/// The mesh as closed_mesh() gives it, which is tried first and then stays as it is, if it encloses
/// anything. Otherwise triangles that are there twice are dropped, those that turn the other way as
/// well where fewer edges are open then or nothing was enclosed before, and corners joined, those
/// of open edges first, at a distance that is no larger than needed. Then faces are turned to
/// agree, and flat holes of up to kMaxFilledEdges edges get a face each. Faults: those of
/// closed_mesh(), holes that are bent or larger, and surfaces that enclose next to nothing even
/// then.
std::variant<RepairedMesh, MeshFault> repaired_mesh(const PolygonMesh& polygons);

}  // namespace graycube
