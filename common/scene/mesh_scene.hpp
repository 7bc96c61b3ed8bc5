// A scene of one mesh, for files that hold nothing else.
#pragma once

#include "csg/triangle_mesh.hpp"
#include "scene/openscad.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// One object of the default material, framed and lit like an OpenSCAD model. The mesh must be closed.
Scene scene_of_mesh(TriangleMesh mesh, const OpenscadOptions& options = {});

}  // namespace graycube
