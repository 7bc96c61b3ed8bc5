// Where a BRL-CAD model's light comes from.
#pragma once

#include <cstddef>
#include <vector>

#include "formats/brlcad/database/report.hpp"
#include "formats/brlcad/shader.hpp"
#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace graycube::brlcad {

/// A region that shines: its object's index in the scene, its parameters, and the map from the
/// coordinates of its first solid to the world's, which turns its beam. Its material is its own.
struct LampObject {
  std::size_t object = 0;
  BrlcadLamp lamp;
  Affine first_solid;
};

/// Gives the scene the lights of its lamps, in the middle of their `bounds` (one box an object),
/// and takes invisible lamps out of it. Without lamps it gets the light that rt makes, beside the
/// eye and without shadows. The camera must be set; `view_size` is the width of its view.
void light_scene(const std::vector<LampObject>& lamps, const std::vector<Aabb>& bounds,
                 double view_size, Scene& scene, BrlcadReport& report);

}  // namespace graycube::brlcad
