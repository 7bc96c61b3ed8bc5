#pragma once

#include <cstdint>

#include "geometry/vec.hpp"
#include "shading/pattern.hpp"

namespace graycube {

enum class ShadingModel : std::uint8_t {
  kPhong,
  kTorranceSparrow,
  kHallGreenberg,
  kRt = 16,  // as BRL-CAD's rt shades its plastic, glass and mirror
  kRtLamp,   // as rt shows a lamp
};

/// Coefficients of the photometric model, all ≥ 0, transmit ≤ 1, ior > 0.
struct Material {
  Rgb color{1, 1, 1};
  double ambient = 0.1;
  double diffuse = 0.9;
  double specular = 0;
  double shininess = 1;
  double reflect = 0;
  double transmit = 0;
  double ior = 1;
  ShadingModel model = ShadingModel::kPhong;
  /// Takes the place of the colour where there is one, but not in what shines through.
  Pattern pattern = {};

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace graycube
