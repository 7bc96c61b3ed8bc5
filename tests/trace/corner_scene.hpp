// A scene whose work lies in a corner of the picture.
#pragma once

#include "csg/random_model.hpp"

namespace graycube::testing {

/// A ball in a corner of the picture, lit from the eye's side.
inline Scene corner_scene() {
  Scene scene = scene_of({node_of(SphereShape{{0, 0, 0}, 1})});
  scene.settings.camera.eye = {0, 0, -10};
  scene.settings.camera.look_at = {3, 2, 0};
  scene.settings.camera.up = {0, 1, 0};
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 60;
  scene.settings.image = {128, 96, 1};
  scene.settings.lights = {{{1, 3, -9}, {1, 1, 1}, Falloff::kNone},
                           {{-1, 2, -9}, {1, 1, 1}, Falloff::kNone}};
  return scene;
}

}  // namespace graycube::testing
