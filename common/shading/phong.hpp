// The photometric model at a point of a surface (docs/scene.md, "Shading").
#pragma once

#include <cmath>
#include <optional>

#include "geometry/portable_math.hpp"
#include "geometry/vec.hpp"
#include "shading/material.hpp"

namespace graycube {

/// The mirror direction of d about the unit normal n.
inline Vec3 reflected(const Vec3& d, const Vec3& n) { return d - (2 * dot(d, n)) * n; }

/// The direction of unit d behind a surface whose unit normal n is turned against d; `eta` is the
/// ratio of the refractive index before the surface to that behind it. Nothing on total reflection.
inline std::optional<Vec3> refracted(const Vec3& d, const Vec3& n, double eta) {
  const double cosine = -dot(d, n);
  const double k = 1 - eta * eta * (1 - cosine * cosine);
  if (k < 0) return std::nullopt;
  return normalized(eta * d + (eta * cosine - std::sqrt(k)) * n);
}

/// The share of light from unit direction l that is reflected towards the viewer, where n·l > 0:
/// Phong (1975); r is the mirror direction of the viewing ray.
Rgb phong(const Material& m, double n_dot_l, const Vec3& r, const Vec3& l);

}  // namespace graycube
