// Triangle meshes as values: closed surfaces whose triangles turn counterclockwise seen from
// outside. mesh/close_mesh.hpp makes one from the polygons of a file, mesh/mesh.hpp intersects
// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/plane.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// Indices into the points.
using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  /// Planes of other solids in which triangles lie (coincidence/coincidence.hpp), and the index of
  /// each triangle's plane, or kOwnPlane; both empty if no triangle has one.
  static constexpr std::uint32_t kOwnPlane = 0xFFFFFFFFu;
  std::vector<Plane> planes{};
  std::vector<std::uint32_t> plane_of{};

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// The most triangles, and points, of all meshes of a scene together.
inline constexpr std::uint32_t kMaxMeshTriangles = 1u << 23;
inline constexpr std::uint32_t kMaxMeshPoints = 1u << 23;

}  // namespace graycube
