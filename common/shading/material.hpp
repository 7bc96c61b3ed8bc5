#pragma once

#include <cstdint>

#include "geometry/vec.hpp"
#include "shading/optics.hpp"
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
  /// Of Torrance–Sparrow's and Hall–Greenberg's models. Where light goes through, all three indices
  /// are `ior` and nothing is absorbed.
  Optics optics = {};

  friend bool operator==(const Material&, const Material&) = default;
};

/// Whether Fresnel's equations say how much a surface of the material reflects.
inline bool has_fresnel(const Material& m) {
  return m.model == ShadingModel::kTorranceSparrow || m.model == ShadingModel::kHallGreenberg;
}
/// Whether light is dimmed on its way through the material.
inline bool attenuates(const Material& m) {
  return m.model == ShadingModel::kHallGreenberg && max_component(m.optics.attenuation) > 0;
}

}  // namespace graycube
