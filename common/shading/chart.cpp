#include "shading/chart.hpp"

#include <cmath>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// What is nearer than this part of a solid's height to an end lies on it.
constexpr double kOnEnd = 1e-6;

double clamped(double v) { return v > 0 ? std::fmin(v, 1) : 0; }

double distance(double x, double y) { return std::sqrt(x * x + y * y); }

/// The angle of (x, y) from x towards y, as a part of a full turn.
double turn(double x, double y) {
  const double r = distance(x, y);
  if (!(r > 0)) return 0;
  const double half = portable_acos(x / r) / (2 * kPi);
  return y < 0 ? 1 - half : half;
}

Vec3 on_sphere(const Vec3& p) {
  const double r = length(p);
  return {turn(p.x, p.y), r > 0 ? 1 - portable_acos(p.z / r) / kPi : 0.5, 0};
}

/// The angle about the ring is counted from its inside by way of its underside.
Vec3 on_torus(const Vec3& p) { return {turn(p.x, p.y), turn(1 - distance(p.x, p.y), -p.z), 0}; }

double on_end(EndChart end, double r) { return end == EndChart::kOneAtRim ? r : 1 - r; }

Vec3 on_round(const Chart& chart, const Vec3& p) {
  if (chart.ends[0] != EndChart::kNone && std::fabs(p.z) <= kOnEnd) {
    return {turn(p.x, p.y), on_end(chart.ends[0], distance(p.x, p.y)), 0};
  }
  // Elliptic ends of other proportions turn the lines of equal longitude.
  const auto& [a, b] = chart.top_radii;
  const double x = p.x / ((1 - p.z) + p.z * a), y = p.y / ((1 - p.z) + p.z * b);
  const bool is_on_top = chart.ends[1] != EndChart::kNone && std::fabs(p.z - 1) <= kOnEnd;
  return {turn(x, y), is_on_top ? on_end(chart.ends[1], distance(x, y)) : p.z, 0};
}

Vec3 on_trough(const Vec3& p) {
  if (std::fabs(p.z) <= kOnEnd) return {0.5 - 0.5 * p.y, p.x, 0};
  const double r = distance(p.y, p.z);
  const double u = r > 0 ? portable_acos(p.y / r) / kPi : 0.5;
  const bool is_end = std::fabs(p.x) <= kOnEnd || std::fabs(p.x - 1) <= kOnEnd;
  return {u, is_end ? r : p.x, 0};
}

/// Goes from 0 to 1 and back.
double to_and_fro(double v) {
  const double part = std::fabs(v) - 2 * std::floor(0.5 * std::fabs(v));
  return part < 1 ? part : 2 - part;
}

Vec3 on_faces(const Chart& chart, const Vec3& p) {
  Vec3 nearest = chart.maps.front().point(p);
  for (std::size_t i = 1; i < chart.maps.size(); ++i) {
    const Vec3 at = chart.maps[i].point(p);
    if (std::fabs(at.z) < std::fabs(nearest.z)) nearest = at;
  }
  return nearest;
}

Vec3 unclamped(const Chart& chart, const Vec3& p) {
  if (chart.kind == ChartKind::kFaces) return on_faces(chart, p);
  const Vec3 at = chart.maps.front().point(p);
  switch (chart.kind) {
    case ChartKind::kSphere: return on_sphere(at);
    case ChartKind::kTorus: return on_torus(at);
    case ChartKind::kRound: return on_round(chart, at);
    case ChartKind::kTrough: return on_trough(at);
    case ChartKind::kPlane: return {to_and_fro(at.x), to_and_fro(at.y), 0};
    case ChartKind::kFaces:
    case ChartKind::kNone: break;
  }
  return at;
}

}  // namespace

Vec3 chart_point(const Chart& chart, const Vec3& p) {
  const Vec3 at = unclamped(chart, p);
  return {clamped(at.x), clamped(at.y), 0};
}

}  // namespace graycube
