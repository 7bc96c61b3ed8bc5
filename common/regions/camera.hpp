// The camera as a frame of unit vectors, and the primary rays it shoots.
#pragma once

#include <cstdint>

#include "geometry/ray.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// `right` points to larger x in the picture, `down` to larger y, `forward` along the view.
struct CameraFrame {
  ImageSize image;
  Projection projection = Projection::kPerspective;
  Vec3 eye, right, down, forward;
  /// Width of one (square) pixel: at distance 1 along `forward` in perspective, in scene units
  /// otherwise.
  double pixel_size = 0;
  /// A ray's point in its subcell: share of the width from the left, of the height from the top.
  double sample_x = 0.5, sample_y = 0.5;

  /// The camera must be valid (read_scene checks): eye ≠ look_at, up not along the view, fov in
  /// range.
  static CameraFrame from(const Camera& camera, const ImageSize& image);

  /// Position of pixel edge number `edge` (0 … width, beyond is fine) relative to the picture's
  /// middle, in the unit of pixel_size: c with boundary plane x = c · z (perspective) or x = c.
  double column_position(double edge) const { return (edge - 0.5 * image.width) * pixel_size; }
  double row_position(double edge) const { return (edge - 0.5 * image.height) * pixel_size; }

  /// The primary ray of sample (sx, sy), each 0 … samples − 1, of pixel (x, y): through the
  /// camera's point of that subcell. Unit direction; perspective rays start at the eye,
  /// orthographic ones on the plane through the eye.
  Ray primary_ray(std::uint32_t x, std::uint32_t y, std::uint32_t sx, std::uint32_t sy) const;
};

}  // namespace graycube
