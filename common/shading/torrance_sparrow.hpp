// K. E. Torrance & E. M. Sparrow, Theory for Off-Specular Reflection From Roughened Surfaces,
// J. Opt. Soc. Am. 57 (1967), in the terms of J. F. Blinn, Models of Light Reflection for Computer
// Synthesized Pictures (SIGGRAPH 1977): docs/shading.md has the formulas.
#pragma once

#include "geometry/vec.hpp"
#include "shading/material.hpp"
#include "shading/surface_view.hpp"

namespace graycube {

/// Light that V-shaped grooves of mirroring facets reflect from unit direction l to the viewer, as
/// a share of what a white matt surface facing l would; n·l > 0. Symmetric in l and the viewer once
/// it is divided by n·l.
Rgb facet_highlight(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l);
/// That, times `specular`, and diffuse light as Phong's.
Rgb torrance_sparrow(const Material& m, const SurfaceView& at, double n_dot_l, const Vec3& l);

}  // namespace graycube
