// A scene of one mesh, for files that hold nothing else.
#pragma once

#include "formats/view/frame.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// A scene with the mesh as its one object, in the default material, framed and lit like an
/// OpenSCAD model; its digits are the mesh's. The mesh must be closed.
Scene scene_of_mesh(MeshShape mesh, const Frame& frame = {});

}  // namespace graycube
