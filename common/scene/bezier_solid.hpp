// Solids bounded by Bézier patches, as meshes with the tolerance that their shape names.
#pragma once

#include <variant>

#include "bezier/division.hpp"
#include "bezier/net_mesh.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline double tolerance_of(const BezierShape& shape) {
  return shape.tolerance > 0 ? shape.tolerance : default_tolerance(shape.net);
}
/// A fault if the patches enclose nothing.
inline std::variant<TriangleMesh, MeshFault> mesh_of(const BezierShape& shape) {
  return mesh_of(shape.net, tolerance_of(shape));
}

}  // namespace graycube
