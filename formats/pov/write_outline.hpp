// Lathes and sweeps as POV-Ray has them, exactly: both are built about its y axis and turned to z.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace graycube {

// The object's brace is left open, for its modifiers.
std::string pov_lathe(const LatheShape& lathe);
std::string pov_prism(const SweepShape& sweep);

}  // namespace graycube
