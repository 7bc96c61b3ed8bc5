// BRL-CAD's shaders as materials.
#pragma once

#include <array>
#include <string>

#include "formats/brlcad/database/report.hpp"
#include "shading/material.hpp"

namespace graycube {

struct BrlcadSurface {
  Material material;
  bool is_light = false;
  /// For lights: the part of full brightness.
  double brightness = 1;
};

/// `shader` is a name and its parameters, `a=1 b=2` or `{a 1 b 2}`; empty is plastic. Others than
/// plastic, glass, mirror and light become plastic, with one warning a kind.
BrlcadSurface brlcad_surface(const std::string& shader, const std::array<int, 3>& rgb,
                             BrlcadReport& report);

}  // namespace graycube
