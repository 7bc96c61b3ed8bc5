// What the models that know Fresnel's equations ask of a material besides (docs/shading.md).
#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/vec.hpp"

namespace graycube {

/// The least and the largest refractive index, and the largest absorption: beyond those of any
/// substance, and far from where the squares of Fresnel's equations leave a double's range.
inline constexpr double kLeastIndex = 1e-3, kMostIndex = 1e3;
/// The index of those materials, unless they have another: that of crown glass.
inline constexpr double kDefaultIndex = 1.5;
/// In radians. Highlights below the least are a few pixels that no picture shows well; with the
/// largest as many facets stand upright as nearly lie.
inline constexpr double kLeastRoughness = 1e-3, kMostRoughness = 1;
/// The most materials of a scene that dim light on its way through them: a ray's record has a byte
/// for the one that it is in.
inline constexpr std::size_t kMaxMedia = 255;

struct Optics {
  /// The refractive index n + ik for red, green and blue: n, and k, which metals have.
  Rgb index{kDefaultIndex, kDefaultIndex, kDefaultIndex}, absorption{0, 0, 0};
  /// a: light is dimmed by e^−a in each scene unit of its way through the solid.
  Rgb attenuation{0, 0, 0};
  /// The angle between a facet and the surface at which facets are 1/e as frequent, in radians.
  double roughness = 0.2;
  /// The exponent of the highlights of lights behind the surface.
  double transmit_shininess = 1;

  friend bool operator==(const Optics&, const Optics&) = default;
};

}  // namespace graycube
