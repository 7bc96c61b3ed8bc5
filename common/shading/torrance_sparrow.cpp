#include "shading/torrance_sparrow.hpp"

#include <algorithm>

#include "geometry/portable_math.hpp"
#include "shading/fresnel.hpp"

namespace graycube {

Rgb facet_highlight(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l) {
  const Vec3 sum = l + at.to_viewer;
  const double size = length(sum);
  const double n_dot_v = dot(at.normal, at.to_viewer);
  if (!(size > 0) || !(n_dot_v > 0)) return {0, 0, 0};
  const Vec3 h = (1 / size) * sum;
  const double n_dot_h = dot(at.normal, h), v_dot_h = dot(at.to_viewer, h);
  if (!(n_dot_h > 0) || !(v_dot_h > 0)) return {0, 0, 0};
  const double slope = portable_acos(n_dot_h) / m.optics.roughness;
  const double facets = portable_exp(-slope * slope);
  // G / (n·v), which stays finite where the surface is seen from the side.
  const double grooves = 2 * n_dot_h / v_dot_h;
  const double unhidden = std::min({1 / n_dot_v, grooves, grooves * n_dot_l / n_dot_v});
  const double share = facets * unhidden / (4 * m.optics.roughness * m.optics.roughness);
  return share * fresnel(m, v_dot_h, at.is_within);
}

Rgb torrance_sparrow(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l) {
  const Rgb diffuse = (m.diffuse * n_dot_l * (1 - m.transmit)) * m.color;
  if (m.specular == 0) return diffuse;
  return diffuse + m.specular * facet_highlight(m, at, n_dot_l, l);
}

}  // namespace graycube
