// Fresnel's equations: how much of the light that falls on a smooth surface is reflected.
#pragma once

#include "geometry/vec.hpp"
#include "shading/material.hpp"

namespace graycube {

/// The share of unpolarised light that is reflected, 0 … 1, where it falls at an angle of that
/// cosine on a substance of index n + ik, relative to where it comes from. Total reflection is 1.
/// (Born & Wolf, Principles of Optics, 1.5 and 14.2.)
double fresnel(double cosine, double n, double k);

/// The same for red, green and blue. From within, light meets the index of what is outside, 1; a
/// metal is taken from within as from outside.
Rgb fresnel(const Material& m, double cosine, bool is_within);

}  // namespace graycube
