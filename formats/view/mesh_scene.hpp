// A scene of the meshes of a file that holds nothing else.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "formats/view/frame.hpp"
#include "scene/scene.hpp"

namespace graycube {

struct SceneMesh {
  std::string name{};
  MeshShape shape{};
  /// Red, green, blue and alpha in sRGB, 0 … 1; without it, the default material.
  std::optional<std::array<double, 4>> color{};
};

/// A scene with an object for each mesh, called "mesh" where it has no name, framed and lit like an
/// OpenSCAD model. Its digits are the most that a mesh has. The meshes must be closed.
Scene scene_of_meshes(std::vector<SceneMesh> meshes, const Frame& frame = {});

/// The same of one mesh.
Scene scene_of_mesh(MeshShape mesh, const Frame& frame = {});

}  // namespace graycube
