#include "formats/openscad/sweep_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr double kLeastRadius = 0.00000095367431640625;
constexpr double kDegree = 3.14159265358979323846 / 180;
/// The length by which holes reach beyond the ends: in heights, and in degrees.
constexpr double kHoleReach = 0.25;
constexpr double kHoleTurn = 5;

using Ring = std::vector<Vec3>;

double squared(const Vec3& v) { return dot(v, v); }

/// Rings of equally many points, joined by triangles with the shorter diagonal, as in OpenSCAD; the
/// first and the last ring close the mesh, or are joined with one another.
PolygonMesh joined(const std::vector<Ring>& rings, bool is_closed) {
  PolygonMesh mesh;
  const auto n = static_cast<std::uint32_t>(rings.front().size());
  for (const Ring& ring : rings) mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  const auto count = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t r = 0; r + (is_closed ? 0 : 1) < count; ++r) {
    const std::uint32_t low = r * n, high = (r + 1) % count * n;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      const std::uint32_t a = low + i, b = low + j, c = high + j, d = high + i;
      const auto& p = mesh.points;
      if (squared(p[a] - p[c]) <= squared(p[b] - p[d])) {
        mesh.add_face(std::array{a, b, c});
        mesh.add_face(std::array{a, c, d});
      } else {
        mesh.add_face(std::array{a, b, d});
        mesh.add_face(std::array{b, c, d});
      }
    }
  }
  if (is_closed) return mesh;
  std::vector<std::uint32_t> cap(n);
  std::iota(cap.rbegin(), cap.rend(), 0u);
  mesh.add_face(cap);
  std::iota(cap.begin(), cap.end(), (count - 1) * n);
  mesh.add_face(cap);
  return mesh;
}

Ring ring_at(const FlatLoop& loop, const LinearSweep& sweep, double share, double z) {
  const FlatPoint scale{1 + (sweep.scale.x - 1) * share, 1 + (sweep.scale.y - 1) * share};
  const double c = cos_degrees(-sweep.twist * share), s = sin_degrees(-sweep.twist * share);
  Ring ring;
  for (const FlatPoint& p : loop) {
    ring.push_back({scale.x * (c * p.x - s * p.y), scale.y * (s * p.x + c * p.y), z});
  }
  return ring;
}

PolygonMesh swept_loop(const FlatLoop& loop, const LinearSweep& sweep, bool is_hole) {
  std::vector<Ring> rings;
  const double height = sweep.high - sweep.low;
  if (is_hole) rings.push_back(ring_at(loop, sweep, 0, sweep.low - kHoleReach * height));
  for (int i = 0; i <= sweep.slices; ++i) {
    const double share = static_cast<double>(i) / sweep.slices;
    rings.push_back(
        ring_at(loop, sweep, share, i == sweep.slices ? sweep.high : sweep.low + share * height));
  }
  const bool ends_in_point = sweep.scale.x == 0 || sweep.scale.y == 0;
  if (is_hole && !ends_in_point)
    rings.push_back(ring_at(loop, sweep, 1, sweep.high + kHoleReach * height));
  return joined(rings, false);
}

/// The loop as rings at the given angles.
PolygonMesh turned_loop(const FlatLoop& loop, const std::vector<double>& angles, bool is_closed) {
  std::vector<Ring> rings;
  for (const double angle : angles) {
    const double c = cos_degrees(angle), s = sin_degrees(angle);
    Ring ring;
    for (const FlatPoint& p : loop) ring.push_back({p.x * c, p.x * s, p.y});
    rings.push_back(std::move(ring));
  }
  return joined(rings, is_closed);
}

/// The length of Archimedes' spiral r = a θ from 0 to `angle`, which is a ∫ √(1 + θ²).
double spiral_length(double a, double angle) {
  const double root = std::sqrt(1 + angle * angle);
  return 0.5 * a * (angle * root + std::log(angle + root));
}

}  // namespace

// The formulas are those of OpenSCAD 2021.01's Calc.cc, stated anew.
int slices_of(const FlatLoops& loops, const LinearSweep& sweep) {
  if (sweep.slices > 0) return sweep.slices;
  const ScadFineness& f = sweep.fineness;
  const double height = sweep.high - sweep.low, twist = std::fabs(sweep.twist);
  double radius2 = 0, change2 = 0;
  for (const FlatLoop& loop : loops) {
    for (const FlatPoint& p : loop) {
      radius2 = std::max(radius2, p.x * p.x + p.y * p.y);
      const double dx = (1 - sweep.scale.x) * p.x, dy = (1 - sweep.scale.y) * p.y;
      change2 = std::max(change2, dx * dx + dy * dy);
    }
  }
  const double radius = std::sqrt(radius2);
  double slices = 1;
  if (twist > 0) {
    double length = std::sqrt(twist * kDegree * twist * kDegree * radius2 + height * height);
    if (sweep.scale.x == sweep.scale.y && sweep.scale.x != 1) {
      const double scale = sweep.scale.x, turn = twist * kDegree;
      const double end = scale > 1 ? turn * scale / (scale - 1) : turn / (1 - scale);
      const double flat =
          spiral_length(radius / end, end) - spiral_length(radius / end, end - turn);
      length = std::sqrt(flat * flat + height * height);
    }
    const double least = std::max(std::ceil(twist / 120), 1.0);
    slices = least;
    if (radius >= kLeastRadius) {
      slices = f.fn > 0
                   ? std::max(std::ceil(twist / 360 * f.fn), least)
                   : std::max(std::min(std::ceil(twist / f.fa), std::ceil(length / f.fs)), least);
    }
  }
  if (sweep.scale.x != sweep.scale.y && std::sqrt(change2) >= kLeastRadius) {
    const double uneven =
        f.fn > 0 ? std::floor(f.fn) : std::ceil(std::sqrt(change2 + height * height) / f.fs);
    slices = std::max(slices, uneven);
  }
  return static_cast<int>(std::clamp(slices, 1.0, double{kMaxOpenscadSides}));
}

std::vector<SweptRegion> swept(const FlatLoops& loops, const LinearSweep& sweep) {
  LinearSweep cut = sweep;
  cut.slices = slices_of(loops, sweep);
  std::vector<SweptRegion> regions;
  for (const FlatRegion& region : regions_of(loops)) {
    SweptRegion& out = regions.emplace_back();
    out.whole = swept_loop(region.outline, cut, false);
    for (const FlatLoop& hole : region.holes) {
      out.holes.push_back(swept_loop({hole.rbegin(), hole.rend()}, cut, true));
    }
  }
  return regions;
}

int steps_of(const FlatLoops& loops, const TurnSweep& sweep) {
  const auto [lo, hi] = flat_bounds(loops);
  const double share = std::fabs(sweep.angle) / 360;
  const int around = fragments(std::max(hi.x, 0.0) - std::min(lo.x, 0.0), sweep.fineness);
  return std::max(static_cast<int>(around * share), sweep.angle == 360 ? 3 : 1);
}

std::vector<SweptRegion> turned_mesh(const FlatLoops& loops, const TurnSweep& sweep) {
  const bool is_closed = sweep.angle == 360;
  const int steps = steps_of(loops, sweep);
  const double reach =
      std::min(kHoleTurn, (360 - std::fabs(sweep.angle)) / 3) * (sweep.angle > 0 ? 1 : -1);
  std::vector<double> angles;
  // OpenSCAD starts a whole turn on the negative side.
  for (int i = 0; i < steps + (is_closed ? 0 : 1); ++i) {
    angles.push_back((is_closed ? 180 : 0) + sweep.angle * i / steps);
  }
  std::vector<double> beyond = angles;
  if (!is_closed) {
    beyond.insert(beyond.begin(), -reach);
    beyond.push_back(sweep.angle + reach);
  }
  std::vector<SweptRegion> regions;
  for (const FlatRegion& region : regions_of(loops)) {
    SweptRegion& out = regions.emplace_back();
    out.whole = turned_loop(region.outline, angles, is_closed);
    for (const FlatLoop& hole : region.holes) {
      out.holes.push_back(turned_loop({hole.rbegin(), hole.rend()}, beyond, is_closed));
    }
  }
  return regions;
}

}  // namespace graycube
