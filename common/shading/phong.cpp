#include "shading/phong.hpp"

namespace graycube {

Rgb phong(const Material& m, double n_dot_l, const Vec3& r, const Vec3& l) {
  const Rgb diffuse = (m.diffuse * n_dot_l * (1 - m.transmit)) * m.color;
  if (m.specular == 0) return diffuse;
  const double cosine = dot(r, l);
  const double highlight = m.specular * (cosine > 0         ? portable_pow(cosine, m.shininess)
                                         : m.shininess == 0 ? 1.0
                                                            : 0.0);
  return diffuse + Rgb{highlight, highlight, highlight};
}

}  // namespace graycube
