// Finds the parts of a scene that the format has but this version can't compute.
#pragma once

#include <vector>

#include "formats/json/scene_error.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// An error for each material whose shading model has a name but no code yet, in the order of the
/// materials.
std::vector<SceneError> unbuilt_parts(const Scene& scene);

}  // namespace graycube
