#include "shading/pattern.hpp"

#include <cmath>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

Rgb camouflage(const Pattern& m, const Vec3& p) {
  const double noise = fractal_noise(p, m.octaves);
  return m.colors[noise < m.thresholds[0] ? 0 : noise < m.thresholds[1] ? 1 : 2];
}

/// The sine of turbulence, which is about 0 … 1, in half turns.
Rgb marble(const Pattern& m, const Rgb& color, const Vec3& p) {
  const double vein = sin_degrees(180 * turbulence(p, m.octaves));
  const auto mixed = [&](double own, double other) {
    return std::fmax(0, vein * own + (1 - vein) * other);
  };
  const Rgb& other = m.colors[0];
  return {mixed(color.r, other.r), mixed(color.g, other.g), mixed(color.b, other.b)};
}

Rgb checker(const Pattern& m, const Vec3& p) {
  const double cubes = std::floor(p.x) + std::floor(p.y) + std::floor(p.z);
  return m.colors[cubes - 2 * std::floor(0.5 * cubes) == 0 ? 0 : 1];
}

}  // namespace

Rgb color_at(const Pattern& pattern, const Rgb& color, const Vec3& p) {
  const Vec3 at = pattern.to_pattern.point(p);
  switch (pattern.kind) {
    case PatternKind::kCamouflage: return camouflage(pattern, at);
    case PatternKind::kMarble: return marble(pattern, color, at);
    case PatternKind::kChecker: return checker(pattern, at);
    case PatternKind::kNone: break;
  }
  return color;
}

}  // namespace graycube
