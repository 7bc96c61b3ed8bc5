#pragma once

#include <string>

#include "scene/scene.hpp"

namespace graycube {

/// The scene as a scene file (docs/scene.md): materials, shapes, lights and objects one to a
/// line, so that files diff well; transforms as matrices; every number in the fewest digits that
/// read back to the same double. What is written reads back to an equal scene, provided that the
/// scene is one that the reader could have given: indices in range, names unique and in UTF-8.
/// Throws an UnrenderableScene (scene/scene_fault.hpp) when a number isn't finite.
std::string write_scene_text(const Scene& scene);

}  // namespace graycube
