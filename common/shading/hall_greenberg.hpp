// R. A. Hall & D. P. Greenberg, A Testbed for Realistic Image Synthesis, IEEE Computer Graphics and
// Applications 3(8) (1983): docs/shading.md has the formulas.
#pragma once

#include "geometry/vec.hpp"
#include "shading/material.hpp"
#include "shading/surface_view.hpp"

namespace graycube {

/// Whether the surface shows highlights of lights behind it.
inline bool has_light_from_behind(const Material& m) {
  return m.model == ShadingModel::kHallGreenberg && m.transmit > 0 && m.specular > 0;
}

/// The share of light from unit direction l, where n·l > 0, that is sent to the viewer: diffuse
/// light as Phong's, and a highlight by the normal that would mirror the light to the viewer.
Rgb hall_greenberg(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l);
/// The same of a light behind the surface, n·l < 0, by the normal that would refract it to the
/// viewer; has_light_from_behind() only.
Rgb hall_greenberg_from_behind(const Material& m, const SurfaceView& at, const Vec3& l);

}  // namespace graycube
