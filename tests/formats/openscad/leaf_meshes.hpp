// The meshes among a scene's leaves, and their volumes.
#pragma once

#include <set>
#include <vector>

#include "scene/scene.hpp"

namespace graycube::testing {

inline void add_meshes(const CsgNode& node, std::vector<TriangleMesh>& meshes) {
  if (const auto* mesh = std::get_if<MeshShape>(&node.value)) {
    meshes.push_back(mesh->mesh);
    for (Vec3& p : meshes.back().points) {
      if (node.transform) p = node.transform->point(p);
    }
  }
  if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
    for (const CsgNode& child : inner->children) add_meshes(child, meshes);
  }
}

inline std::vector<TriangleMesh> meshes_of(const Scene& scene) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects) add_meshes(object.csg, meshes);
  return meshes;
}

inline double mesh_volume(const std::vector<TriangleMesh>& meshes) {
  double sum = 0;
  for (const TriangleMesh& mesh : meshes) {
    for (const auto& [a, b, c] : mesh.triangles)
      sum += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  }
  return sum;
}

/// How many different heights the corners have.
inline std::size_t levels_of(const TriangleMesh& mesh) {
  std::set<double> heights;
  for (const Vec3& p : mesh.points) heights.insert(p.z);
  return heights.size();
}

}  // namespace graycube::testing
