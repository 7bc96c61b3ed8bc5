// BRL-CAD's shaders as materials and lamps.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "formats/brlcad/database/report.hpp"
#include "geometry/vec.hpp"
#include "shading/material.hpp"

namespace graycube {

/// rt's ambient light: how much of a surface's colour it brings where the surface faces the eye.
inline constexpr double kBrlcadAmbient = 0.4;

/// A lamp's parameters, with rt's defaults.
struct BrlcadLamp {
  /// Lumens, which count relative to the brightest lamp; or, if above 0, the part of full light.
  double intensity = 1, fraction = -1;
  bool has_shadows = true;
  /// Shines from where the lamp is, seen from the origin, in parallel rays.
  bool is_infinite = false;
  bool is_invisible = false;
  /// Half the angle of its beam, 0 … 180, and the point that it is aimed at. Without one it is
  /// aimed along −z in the coordinates of its first solid.
  double angle_degrees = 180;
  bool has_target = false;
  Vec3 target;
};

struct BrlcadSurface {
  Material material;
  /// A pattern of u and v, which only a solid can place: the material has its colour at 0, 0.
  std::optional<Pattern> on_solids;
  /// The region isn't drawn, as by rt: what it looks like is what rays see that meet nothing.
  bool is_environment = false;
  bool is_light = false;
  BrlcadLamp lamp;
};

/// `shader` is a name and its parameters, `a=1 b=2` or `{a 1 b 2}`; empty is plastic. A `stack` is
/// its last member that is plastic, glass, mirror or light, with the colours of its last pattern;
/// what else it has isn't drawn. Alone, other shaders become plastic. Both is told once a kind;
/// `region` is the name that is told. The map of a pattern in space is that from the region's
/// coordinates.
BrlcadSurface brlcad_surface(const std::string& shader, const std::array<int, 3>& rgb,
                             const std::string& region, BrlcadReport& report);

}  // namespace graycube
