// STL files of both kinds, made of meshes.
#pragma once

#include <cstring>
#include <string>

#include "mesh/triangle_mesh.hpp"

namespace graycube::testing {

/// The facets of an ASCII file, `edit`ed line by line.
template <typename Edit>
std::string stl_facets(const TriangleMesh& mesh, Edit&& edit) {
  std::string text;
  for (const Triangle& t : mesh.triangles) {
    text += edit("facet normal 0 0 0") + edit("  outer loop");
    for (const std::uint32_t i : t) {
      const Vec3& p = mesh.points[i];
      text += edit("    vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                   std::to_string(p.z));
    }
    text += edit("  endloop") + edit("endfacet");
  }
  return text;
}
inline std::string stl_facets(const TriangleMesh& mesh) {
  return stl_facets(mesh, [](const std::string& line) { return line + "\n"; });
}
inline std::string stl_text(const TriangleMesh& mesh, const std::string& name = "box") {
  return "solid " + name + "\n" + stl_facets(mesh) + "endsolid " + name + "\n";
}

/// A binary file whose header says that it holds `announced` facets.
inline std::string stl_bytes(const TriangleMesh& mesh, std::uint32_t announced) {
  std::string bytes = "solid but binary";
  bytes.resize(80, '\0');
  const auto put = [&](auto v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    bytes.append(raw, sizeof v);
  };
  put(announced);
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (const std::uint32_t i : t) {
      for (int a = 0; a < 3; ++a) put(static_cast<float>(mesh.points[i][a]));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}
inline std::string stl_bytes(const TriangleMesh& mesh) {
  return stl_bytes(mesh, static_cast<std::uint32_t>(mesh.triangles.size()));
}

}  // namespace graycube::testing
