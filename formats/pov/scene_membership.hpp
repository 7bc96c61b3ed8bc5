// Tells whether points lie in a scene's solids as written, for exporters, which need no speed.
#pragma once

#include "geometry/vec.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Whether the point lies in any object. Closed sets, up to rounding. The scene must be one that
/// the reader could have given.
bool any_object_holds(const Scene& scene, const Vec3& point);

}  // namespace graycube
