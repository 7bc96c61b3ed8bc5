// Polygon meshes for tests: boxes, balls, rings, and random convex bodies.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>

#include "geometry/portable_math.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube::testing {

inline TriangleMesh closed(const PolygonMesh& polygons) {
  return std::get<TriangleMesh>(closed_mesh(polygons));
}
inline std::string fault_of(const PolygonMesh& polygons) {
  const auto result = closed_mesh(polygons);
  const auto* fault = std::get_if<MeshFault>(&result);
  return fault == nullptr ? "" : fault->why;
}

/// Six squares, turned counterclockwise seen from outside.
inline PolygonMesh box_polygons(const Vec3& lo, const Vec3& hi) {
  PolygonMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.push_back(
        {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) mesh.add_face(f);
  return mesh;
}

inline void append(PolygonMesh& to, const PolygonMesh& more, bool inside_out = false) {
  const auto base = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), more.points.begin(), more.points.end());
  std::uint32_t begin = 0;
  for (const std::uint32_t end : more.face_ends) {
    std::vector<std::uint32_t> face;
    for (std::uint32_t i = begin; i < end; ++i) face.push_back(base + more.corners[i]);
    if (inside_out) face = {face.rbegin(), face.rend()};
    to.add_face(face);
    begin = end;
  }
}

/// A prism of so many sides about z, its ends cut into triangles about their first corners, as in
/// most files.
inline PolygonMesh drum_polygons(double radius, double lo, double hi, std::uint32_t sides) {
  PolygonMesh mesh;
  for (const double z : {lo, hi}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 360.0 * i / sides;
      mesh.points.push_back({radius * cos_degrees(angle), radius * sin_degrees(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    mesh.add_face(std::array{i, next, sides + next, sides + i});
    if (i == 0 || next == 0) continue;
    mesh.add_face(std::array{0u, next, i});
    mesh.add_face(std::array{sides, sides + i, sides + next});
  }
  return mesh;
}

/// A grid of quads, rows × columns, both ways around: a ring (torus) about z.
inline PolygonMesh ring_polygons(double major, double minor, std::uint32_t rows,
                                 std::uint32_t columns) {
  PolygonMesh mesh;
  for (std::uint32_t r = 0; r < rows; ++r) {
    const double u = 360.0 * r / rows;
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double v = 360.0 * c / columns, d = major + minor * cos_degrees(v);
      mesh.points.push_back({d * cos_degrees(u), d * sin_degrees(u), minor * sin_degrees(v)});
    }
  }
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t r1 = (r + 1) % rows, c1 = (c + 1) % columns;
      mesh.add_face(
          std::array{r * columns + c, r1 * columns + c, r1 * columns + c1, r * columns + c1});
    }
  }
  return mesh;
}

/// A ball of `rings` parallels between the poles and `columns` meridians.
inline PolygonMesh ball_polygons(double radius, std::uint32_t rings, std::uint32_t columns) {
  PolygonMesh mesh;
  mesh.points.push_back({0, 0, radius});
  for (std::uint32_t r = 1; r <= rings; ++r) {
    const double polar = 180.0 * r / (rings + 1);
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double around = 360.0 * c / columns, d = radius * sin_degrees(polar);
      mesh.points.push_back(
          {d * cos_degrees(around), d * sin_degrees(around), radius * cos_degrees(polar)});
    }
  }
  const auto south = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back({0, 0, -radius});
  const auto at = [&](std::uint32_t r, std::uint32_t c) { return 1 + r * columns + c % columns; };
  for (std::uint32_t c = 0; c < columns; ++c) {
    mesh.add_face(std::array{0u, at(0, c), at(0, c + 1)});
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      mesh.add_face(std::array{at(r, c), at(r + 1, c), at(r + 1, c + 1), at(r, c + 1)});
    }
    mesh.add_face(std::array{south, at(rings - 1, c + 1), at(rings - 1, c)});
  }
  return mesh;
}

}  // namespace graycube::testing
