#include "shading/hall_greenberg.hpp"

#include <algorithm>

#include "geometry/portable_math.hpp"
#include "shading/fresnel.hpp"

namespace graycube {
namespace {

double lobe(double cosine, double shininess) {
  return portable_pow(std::clamp(cosine, 0.0, 1.0), shininess);
}

}  // namespace

Rgb hall_greenberg(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l) {
  const Rgb diffuse = (m.diffuse * n_dot_l * (1 - m.transmit)) * m.color;
  if (m.specular == 0) return diffuse;
  const Vec3 sum = l + at.to_viewer;
  const double size = length(sum);
  if (!(size > 0)) return diffuse;
  const Vec3 h = (1 / size) * sum;
  const double highlight = m.specular * lobe(dot(at.normal, h), m.shininess);
  return diffuse + highlight * fresnel(m, dot(at.to_viewer, h), at.is_within);
}

Rgb hall_greenberg_from_behind(const Material& m, const SurfaceView& at, const Vec3& l) {
  const double before = at.is_within ? m.ior : 1, behind = at.is_within ? 1 : m.ior;
  const Vec3 sum = behind * l + before * at.to_viewer;
  const double size = length(sum);
  if (!(size > 0)) return {0, 0, 0};
  // Snell's law holds about the sum of the directions, each times its index: it is the normal, on
  // one side or the other.
  Vec3 h = (1 / size) * sum;
  if (dot(h, at.to_viewer) < 0) h = -h;
  const double n_dot_h = dot(at.normal, h);
  if (!(dot(h, l) < 0) || !(n_dot_h > 0)) return {0, 0, 0};
  const double passing = 1 - fresnel(dot(h, at.to_viewer), behind / before, 0);
  const double highlight =
      m.specular * m.transmit * passing * lobe(n_dot_h, m.optics.transmit_shininess);
  return {highlight, highlight, highlight};
}

}  // namespace graycube
