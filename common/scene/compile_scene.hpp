// Turns the scene as written into the model as rendered: references expanded, transforms applied,
// trees in negation normal form, everything in world coordinates.
#pragma once

#include "csg/model.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// The scene must have passed read_scene's checks (no cycles, every leaf has a material, all maps
/// invertible). Objects whose tree is always empty space or everything are kept: they just have no
/// surface. Throws an UnrenderableScene (scene/scene_fault.hpp) with all solids, lights and places
/// of the eye that leave the range of csg/soundness.hpp; all callers therefore accept the same
/// scenes.
Model compile_scene(const Scene& scene);

}  // namespace graycube
