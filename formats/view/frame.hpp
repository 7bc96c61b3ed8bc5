// The picture for which a model without a view is framed.
#pragma once

#include <cstdint>

#include "shading/settings.hpp"

namespace graycube {

struct Frame {
  /// Both sides at least 1; the camera is framed for this picture.
  ImageSize image{512, 512, 1};
  /// The full horizontal angle, 0 < fov < 180.
  double fov_degrees = 30;
  /// Share of the picture's width or height left free on each side, 0 ≤ margin < 0.5.
  double margin = 0.08;
  std::uint32_t max_depth = 5;
};

}  // namespace graycube
