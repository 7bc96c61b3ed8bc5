// The model of one ball, seen by a camera of 16 × 16 pixels on a coloured background; and a ray
// that misses it.
#pragma once

#include <cstdint>
#include <limits>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"
#include "trace/ray_task.hpp"

namespace graycube::testing {

inline Model one_ball() {
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 16, "height": 16},
    "camera": {"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0],
               "fov": 40},
    "background": [1,0.5,0.25], "lights": [], "materials": {"m": {}},
    "objects": [{"material": "m", "csg": {"type": "sphere", "center": [0,0,0], "radius": 1}}]})");
  REQUIRE(read.scene);
  return compile_scene(*read.scene);
}

/// A reflected ray in the left half of space that meets nothing, with that pixel or number.
inline RayTask ray_into_nothing(std::uint32_t pixel) {
  RayTask ray;
  ray.ray = {{3, 0, 2}, {1, 0, 0}};
  ray.t_max = std::numeric_limits<double>::infinity();
  ray.kind = RayKind::kReflection;
  ray.weight = {1, 1, 1};
  ray.depth = 1;
  ray.credit_exponent = 2;
  ray.hops = 1;
  ray.pixel = pixel;
  return ray;
}

}  // namespace graycube::testing
