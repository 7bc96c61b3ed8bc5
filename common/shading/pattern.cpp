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

/// How bright clouds are at (x, y), about 0 … 1: two sums of four waves each, of ever finer scales,
/// multiplied. G. Y. Gardner, Simulation of Natural Scenes Using Textured Quadric Surfaces (1984),
/// with the numbers of BRL-CAD's liboptical (sh_cloud.c).
double cloud_brightness(double x, double y) {
  constexpr double kFiner = 0.707;
  constexpr int kWaves = 4;
  const auto phase = [](double turns) { return 90 * sin_degrees(360 * turns); };
  double along_x = 2 * x, along_y = y, weight = 1, sum_x = 0, sum_y = 0;
  double phase_x = phase(0.5 * along_y), phase_y = phase(0.5 * along_x);
  for (int i = 0; i < kWaves; ++i) {
    sum_x += weight * sin_degrees(360 * along_x + phase_x) + 1;
    sum_y += weight * sin_degrees(360 * along_y + phase_y) + 1;
    phase_x = phase(along_y);
    phase_y = phase(along_x);
    along_x *= 2;
    along_y *= 2;
    weight *= kFiner;
  }
  return std::fmin(std::fmax(sum_x * sum_y / (2 * kWaves * kWaves), 0), 1);
}

Rgb clouds(const Pattern& m, const Vec3& p) {
  const double cloud = cloud_brightness(p.x, p.y);
  const double sky = std::fmin(std::fmax(1 - (cloud - m.thresholds[0]) / m.thresholds[1], 0), 1);
  return (1 - sky) * Rgb{cloud, cloud, cloud} + sky * m.colors[0];
}

Rgb gradient(const Pattern& m, const Vec3& p) {
  return std::fmax(0, p.x) * m.colors[0] + std::fmax(0, p.y) * m.colors[1];
}

}  // namespace

Rgb color_at(const Pattern& pattern, const Rgb& color, const Vec3& p) {
  const Chart& chart = pattern.chart;
  const Vec3 at =
      pattern.to_pattern.point(chart.kind == ChartKind::kNone ? p : chart_point(chart, p));
  switch (pattern.kind) {
    case PatternKind::kCamouflage: return camouflage(pattern, at);
    case PatternKind::kMarble: return marble(pattern, color, at);
    case PatternKind::kChecker: return checker(pattern, at);
    case PatternKind::kClouds: return clouds(pattern, at);
    case PatternKind::kGradient: return gradient(pattern, at);
    case PatternKind::kNone: break;
  }
  return color;
}

}  // namespace graycube
