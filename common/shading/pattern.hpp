// Patterns: colours that change with the place in a material.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/affine.hpp"
#include "geometry/vec.hpp"
#include "shading/chart.hpp"
#include "shading/lattice_noise.hpp"

namespace graycube {

enum class PatternKind : std::uint8_t {
  kNone,
  kCamouflage,  // three colours: noise below the first threshold, below the second, the rest
  kMarble,      // veins of the material's colour in another one, by turbulence
  kChecker,     // two colours in cubes of side 1
  kClouds,      // grey clouds before the sky, whose colour is the pattern's
  kGradient,    // the first colour times x plus the second one times y
};
inline constexpr std::uint8_t kPatternKinds = 6;

struct Pattern {
  PatternKind kind = PatternKind::kNone;
  /// From the world's coordinates to the pattern's; with a chart, from the chart's.
  Affine to_pattern;
  /// The first colors_of(kind) count.
  std::array<Rgb, 3> colors{{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}}};
  /// Camouflage: the noise where its colours change. Clouds: how bright a cloud is where it begins,
  /// and how much brighter where it hides the sky.
  std::array<double, 2> thresholds{-0.25, 0.25};
  /// Of camouflage and marble.
  NoiseOctaves octaves;
  /// Where u and v lie, if the pattern follows a solid's surface.
  Chart chart;

  friend bool operator==(const Pattern&, const Pattern&) = default;
};

/// How many colours a pattern has besides its material's.
constexpr std::size_t colors_of(PatternKind kind) {
  return kind == PatternKind::kCamouflage                                  ? 3
         : kind == PatternKind::kChecker || kind == PatternKind::kGradient ? 2
                                                                           : 1;
}
constexpr bool has_thresholds(PatternKind kind) {
  return kind == PatternKind::kCamouflage || kind == PatternKind::kClouds;
}
constexpr bool has_noise(PatternKind kind) {
  return kind == PatternKind::kCamouflage || kind == PatternKind::kMarble;
}

/// The colour at p, in the world's coordinates; `color` is that of the material.
Rgb color_at(const Pattern& pattern, const Rgb& color, const Vec3& p);

}  // namespace graycube
