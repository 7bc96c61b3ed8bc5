// A camera that looks along no axis.
#pragma once

#include "regions/camera.hpp"

namespace graycube::testing {

inline CameraFrame oblique_frame(Projection projection, ImageSize image) {
  Camera camera;
  camera.projection = projection;
  camera.eye = {1.3, 2.1, -7.7};
  camera.look_at = {0.2, 0.4, 0.6};
  camera.up = {0.1, 1, 0.05};
  camera.fov_degrees = 50;
  camera.width = 9;
  return CameraFrame::from(camera, image);
}

}  // namespace graycube::testing
