#include "shading/nearest_phong.hpp"

#include "shading/fresnel.hpp"

namespace graycube {

Material nearest_phong(const Material& m) {
  if (!has_fresnel(m)) return m;
  const Rgb of_colour = fresnel(m, 1, false);
  const double mirrored = (of_colour.r + of_colour.g + of_colour.b) / 3;
  Material near = m;
  near.model = ShadingModel::kPhong;
  near.optics = {};
  near.reflect *= mirrored;
  near.transmit *= 1 - mirrored;
  near.specular *= mirrored;
  // Phong's cosine is of twice the angle between h and the normal: cos(2α)^e is about e^−2eα².
  near.shininess = m.shininess / 4;
  if (m.model == ShadingModel::kTorranceSparrow) {
    const double spread = m.optics.roughness * m.optics.roughness;
    near.shininess = 1 / (2 * spread);
    near.specular /= 4 * spread;
  }
  return near;
}

}  // namespace graycube
