// A second renderer for a handful of plain solids, in closed form and without anything of the
// engine but its vectors: what the picture of such a scene must be, pixel by pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/vec.hpp"

namespace graycube::testing {

struct AnalyticHit {
  double t = std::numeric_limits<double>::infinity();
  Vec3 normal;
};

struct AnalyticSphere {
  Vec3 center;
  double radius;

  void meet(const Vec3& o, const Vec3& d, double from, AnalyticHit& hit) const {
    const Vec3 m = o - center;
    const double b = dot(m, d), c = dot(m, m) - radius * radius;
    if (b * b < c) return;
    for (const double t : {-b - std::sqrt(b * b - c), -b + std::sqrt(b * b - c)}) {
      if (t < from || t >= hit.t) continue;
      hit = {t, (1 / radius) * (o + t * d - center)};
      return;
    }
  }
};

/// Six rectangles.
struct AnalyticBox {
  Vec3 lo, hi;

  void meet(const Vec3& o, const Vec3& d, double from, AnalyticHit& hit) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        const double t = ((upper ? hi : lo)[axis] - o[axis]) / d[axis];
        if (!(t >= from && t < hit.t)) continue;
        const Vec3 p = o + t * d;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (p[u] < lo[u] || p[u] > hi[u] || p[v] < lo[v] || p[v] > hi[v]) continue;
        Vec3 n;
        n[axis] = upper ? 1 : -1;
        hit = {t, n};
      }
    }
  }
};

/// Upright: x² + z² ≤ radius² about (x, z) from bottom to top; with a top radius of its own it is a
/// cone.
struct AnalyticColumn {
  double x, z, bottom, top, radius, top_radius;

  double slope() const { return (top_radius - radius) / (top - bottom); }
  double radius_at(double y) const { return radius + slope() * (y - bottom); }
  double distance2(const Vec3& p) const { return (p.x - x) * (p.x - x) + (p.z - z) * (p.z - z); }

  void meet(const Vec3& o, const Vec3& d, double from, AnalyticHit& hit) const {
    for (const double y : {bottom, top}) {
      const double t = (y - o.y) / d.y;
      if (!(t >= from && t < hit.t)) continue;
      if (distance2(o + t * d) > radius_at(y) * radius_at(y)) continue;
      hit = {t, {0, y == top ? 1.0 : -1.0, 0}};
    }
    // |p − axis|² = (r + k (y − bottom))², a quadratic in t.
    const double k = slope(), px = o.x - x, pz = o.z - z, r = radius_at(o.y);
    const double a = d.x * d.x + d.z * d.z - k * k * d.y * d.y;
    const double b = px * d.x + pz * d.z - k * d.y * r;
    const double c = px * px + pz * pz - r * r;
    if (b * b < a * c) return;
    for (const double sign : {-1.0, 1.0}) {
      const double t = (-b + sign * std::sqrt(b * b - a * c)) / a;
      const Vec3 p = o + t * d;
      if (!(t >= from && t < hit.t) || p.y < bottom || p.y > top) continue;
      hit = {t, normalized({p.x - x, -k * radius_at(p.y), p.z - z})};
    }
  }
};

/// y = height, seen from above or below.
struct AnalyticFloor {
  double height;

  void meet(const Vec3& o, const Vec3& d, double from, AnalyticHit& hit) const {
    const double t = (height - o.y) / d.y;
    if (t >= from && t < hit.t) hit = {t, {0, 1, 0}};
  }
};

struct AnalyticSolid {
  std::variant<AnalyticSphere, AnalyticBox, AnalyticColumn, AnalyticFloor> shape;
  Rgb color;
  double ambient, diffuse, specular, shininess, reflect;
};

struct AnalyticScene {
  std::vector<AnalyticSolid> solids;
  struct Light {
    Vec3 position;
    Rgb color;
  };
  std::vector<Light> lights;
  Rgb background;
  int max_depth = 0;

  Rgb seen(const Vec3& o, const Vec3& d, double from = 0, int depth = 0) const {
    const auto [solid, hit] = nearest(o, d, from);
    if (solid == nullptr) return background;
    const Vec3 p = o + hit.t * d;
    const Vec3 n = dot(hit.normal, d) > 0 ? -hit.normal : hit.normal;
    const Vec3 r = d - (2 * dot(d, n)) * n;
    Rgb light = solid->ambient * solid->color;
    for (const Light& source : lights) {
      const double distance = length(source.position - p);
      const Vec3 l = normalized(source.position - p);
      if (dot(n, l) <= 0 || nearest(p, l, kSkip).hit.t < distance) continue;
      const double highlight =
          solid->specular * std::pow(std::max(0.0, dot(r, l)), solid->shininess);
      light = light + source.color * ((solid->diffuse * dot(n, l)) * solid->color +
                                      Rgb{highlight, highlight, highlight});
    }
    if (solid->reflect > 0 && depth < max_depth)
      light = light + solid->reflect * seen(p, r, kSkip, depth + 1);
    return light;
  }

 private:
  /// Beyond the surface that a ray leaves.
  static constexpr double kSkip = 1e-7;
  struct Found {
    const AnalyticSolid* solid;
    AnalyticHit hit;
  };
  Found nearest(const Vec3& o, const Vec3& d, double from) const {
    Found found{nullptr, {}};
    for (const AnalyticSolid& solid : solids) {
      const double before = found.hit.t;
      std::visit([&](const auto& shape) { shape.meet(o, d, from, found.hit); }, solid.shape);
      if (found.hit.t < before) found.solid = &solid;
    }
    return found;
  }
};

}  // namespace graycube::testing
