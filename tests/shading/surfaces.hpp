// Materials and directions for the tests of shading models.
#pragma once

#include <cmath>

#include "csg/dice.hpp"
#include "shading/material.hpp"
#include "shading/surface_view.hpp"

namespace graycube::testing {

inline constexpr double kPi = 3.14159265358979323846;

/// A clean surface without light of its own.
inline Material clean(ShadingModel model, double ior, double absorption = 0) {
  Material m;
  m.model = model;
  m.ambient = 0;
  m.diffuse = 0;
  m.specular = 1;
  m.ior = ior;
  m.optics.index = {ior, ior, ior};
  m.optics.absorption = {absorption, absorption, absorption};
  return m;
}

/// A direction so many degrees from +y, in the x-y plane.
inline Vec3 tilted(double degrees) {
  const double a = degrees * kPi / 180;
  return {std::sin(a), std::cos(a), 0};
}

/// The plane y = 0 as seen from a direction.
inline SurfaceView floor_from(const Vec3& to_viewer) { return {{0, 1, 0}, to_viewer, false}; }

/// A direction above the plane y = 0.
inline Vec3 upward(Dice& dice) {
  const Vec3 d = dice.unit_vector();
  return d.y < 0 ? -d : d;
}

/// The mean over the hemisphere of f(l) · (n·l) / π dω times π: what a surface sends to the viewer
/// if lights of brightness 1 are everywhere; f is the light of one as Material's models have it.
template <typename F>
double lit_from_everywhere(F&& f) {
  constexpr int kRings = 400, kSteps = 800;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double tilt = (i + 0.5) * kPi / 2 / kRings;
    for (int j = 0; j < kSteps; ++j) {
      const double turn = (j + 0.5) * 2 * kPi / kSteps;
      const Vec3 l{std::sin(tilt) * std::cos(turn), std::cos(tilt),
                   std::sin(tilt) * std::sin(turn)};
      sum += f(l) * std::sin(tilt);
    }
  }
  return sum * (kPi / 2 / kRings) * (2 * kPi / kSteps) / kPi;
}

}  // namespace graycube::testing
