// The model of one ball, seen by a camera of 16 × 16 pixels on a coloured background.
#pragma once

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "scene/compile_scene.hpp"

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

}  // namespace graycube::testing
