#include "flat/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/circle_arcs.hpp"

namespace graycube {
namespace {

/// The tolerance for rounding, as a share of the extent of all disks.
constexpr double kRounding = 1e-13;

double extent_of(std::span<const FlatDisk> disks) {
  double extent = 0;
  const FlatPoint origin = disks.front().center;
  for (const FlatDisk& d : disks) {
    extent = std::max({extent, d.radius + std::fabs(d.center.x - origin.x),
                       d.radius + std::fabs(d.center.y - origin.y)});
  }
  return extent;
}

/// The unit normals of the two outer tangents, which have both disks on one side: first that of the
/// tangent on the left, seen from `a` towards `b`.
std::pair<FlatPoint, FlatPoint> tangent_normals(const FlatDisk& a, const FlatDisk& b) {
  const double dx = b.center.x - a.center.x, dy = b.center.y - a.center.y,
               narrowing = a.radius - b.radius;
  if (narrowing == 0) {
    const double l = std::sqrt(dx * dx + dy * dy);
    return {{-dy / l, dx / l}, {dy / l, -dx / l}};
  }
  const double l2 = dx * dx + dy * dy;
  const double across = std::sqrt(std::max(0.0, l2 - narrowing * narrowing));
  return {{(narrowing * dx - across * dy) / l2, (narrowing * dy + across * dx) / l2},
          {(narrowing * dx + across * dy) / l2, (narrowing * dy - across * dx) / l2}};
}

/// The points where the outer tangent with the normal nearest to `direction` touches both disks.
std::array<FlatPoint, 2> touching_points(const FlatDisk& a, const FlatDisk& b,
                                         const FlatPoint& direction) {
  const auto [left, right] = tangent_normals(a, b);
  const auto along = [&](const FlatPoint& n) { return n.x * direction.x + n.y * direction.y; };
  const FlatPoint n = along(left) >= along(right) ? left : right;
  return {FlatPoint{a.center.x + a.radius * n.x, a.center.y + a.radius * n.y},
          FlatPoint{b.center.x + b.radius * n.x, b.center.y + b.radius * n.y}};
}

/// The directions in which no other disk reaches further than this one. Of equal disks the first
/// counts.
CircleArcs foremost_directions(std::span<const FlatDisk> disks, std::size_t which,
                               double tolerance) {
  CircleArcs arcs;
  const FlatDisk& own = disks[which];
  for (std::size_t k = 0; k < disks.size() && !arcs.is_empty(); ++k) {
    if (k == which) continue;
    const FlatDisk& other = disks[k];
    const bool is_same = other.center == own.center && other.radius == own.radius;
    if (is_same && k > which) continue;
    arcs.keep(other.center.x - own.center.x, other.center.y - own.center.y,
              is_same ? -2 * tolerance : own.radius - other.radius, tolerance, k);
  }
  return arcs;
}

/// Drops corners that are the same as the corner before but for rounding.
void join_close(FlatLoop& loop, double tolerance) {
  FlatLoop kept;
  const auto is_close = [&](const FlatPoint& p, const FlatPoint& q) {
    return std::fabs(p.x - q.x) <= tolerance && std::fabs(p.y - q.y) <= tolerance;
  };
  for (const FlatPoint& p : loop) {
    if (kept.empty() || !is_close(kept.back(), p)) kept.push_back(p);
  }
  while (kept.size() > 1 && is_close(kept.front(), kept.back())) kept.pop_back();
  loop = std::move(kept);
}

}  // namespace

FlatRoundHull flat_round_hull(std::span<const FlatDisk> disks) {
  FlatRoundHull hull;
  if (disks.empty()) return hull;
  const double tolerance = kRounding * extent_of(disks);
  std::vector<FlatPoint> points;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (!(disks[i].radius > 0)) {
      points.push_back(disks[i].center);
      continue;
    }
    const CircleArcs arcs = foremost_directions(disks, i, tolerance);
    if (!arcs.is_empty()) hull.disks.push_back(i);
    for (const CircleArcs::Arc& arc : arcs.arcs()) {
      if (arc.is_whole()) continue;
      for (const CircleArcs::End* end : {&arc.from, &arc.to}) {
        // Both disks find this tangent; ordered, so that they compute it by the same expressions.
        const auto [first, second] = std::minmax(i, end->cutter);
        const auto touching = touching_points(disks[first], disks[second], end->direction);
        points.insert(points.end(), touching.begin(), touching.end());
      }
    }
  }
  hull.polygon = flat_hull(std::move(points));
  join_close(hull.polygon, tolerance);
  return hull;
}

}  // namespace graycube
