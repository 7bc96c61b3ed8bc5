#pragma once

#include "shading/material.hpp"

namespace graycube {

/// The material of Phong's model that looks most alike, seen straight, for programs that have no
/// other: highlights as high and about as wide, and as much mirrored and let through. What is of
/// Phong's or BRL-CAD's models stays as it is.
Material nearest_phong(const Material& m);

}  // namespace graycube
