// How BRL-CAD's rt shades (docs/scene.md, "As rt shades"): Phong's model with Schlick's highlight,
// and ambient light that comes from where the ray does. The facts are those of rt's sources,
// liboptical's sh_plastic.c, sh_light.c and refract.c.
#pragma once

#include "geometry/vec.hpp"
#include "shading/material.hpp"

namespace graycube {

inline bool is_rt_model(const Material& m) {
  return m.model == ShadingModel::kRt || m.model == ShadingModel::kRtLamp;
}

/// The share of a surface's own look; the rest is what it mirrors and lets through.
inline double rt_own_share(const Material& m) {
  const double share = 1 - (m.reflect + m.transmit);
  return share > 0 ? share : 0;
}

/// The grey in which rt shows a solid that the eye's plane cuts: it looks for a way out of the
/// solid six times, in vain, and darkens 18 % grey by 0.8 each time.
inline constexpr double kRtCutGrey = 0.18 * 0.8 * 0.8 * 0.8 * 0.8 * 0.8 * 0.8;

/// The part of white ambient light that the surface sends out. `cosine` is that of the angle
/// between the normal and the way back to where the ray came from, 0 … 1. A lamp is half as bright
/// at its rim as in its middle.
inline Rgb rt_ambient(const Material& m, double cosine) {
  const bool is_lamp = m.model == ShadingModel::kRtLamp;
  return (is_lamp ? m.ambient * (0.5 + 0.5 * cosine) : m.ambient * cosine * rt_own_share(m)) *
         m.color;
}

/// The share of light from unit direction l that is reflected towards the viewer, where n·l > 0; r
/// is the mirror direction of the viewing ray. Schlick's highlight: A Fast Alternative to Phong's
/// Specular Model, Graphics Gems IV (1994).
inline Rgb rt_reflected(const Material& m, double n_dot_l, const Vec3& r, const Vec3& l) {
  if (m.model == ShadingModel::kRtLamp) return {0, 0, 0};
  const double share = rt_own_share(m);
  const Rgb diffuse = (share * m.diffuse * n_dot_l) * m.color;
  const double cosine = dot(r, l);
  if (!(cosine > 0)) return diffuse;
  const double highlight =
      share * m.specular * cosine / (m.shininess - m.shininess * cosine + cosine);
  return diffuse + Rgb{highlight, highlight, highlight};
}

}  // namespace graycube
