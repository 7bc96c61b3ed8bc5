// Finds balls, discs and points that can't show in their hull.
#include <algorithm>
#include <cmath>

#include "formats/openscad/hulls/convex_hull.hpp"
#include "formats/openscad/hulls/round_hull.hpp"

namespace graycube {
namespace {

/// Rounding errors, relative to the extent of all points.
constexpr double kRounding = 1e-13;
/// Groups of fewer points aren't worth a hull of their own.
constexpr std::size_t kLeastGroup = 5;
/// With more points than this, triples aren't examined.
constexpr std::size_t kMaxTriplePoints = 64;

bool before(const RoundPoint& a, const RoundPoint& b) {
  if (a.radius != b.radius) return a.radius > b.radius;
  if (a.center.z != b.center.z) return a.center.z < b.center.z;
  return a.center.x != b.center.x ? a.center.x < b.center.x : a.center.y < b.center.y;
}

/// Leaves only points at the corners of their centres' hull; all points must have one radius. All
/// are left if the centres lie in a plane, unless it is a level plane of discs.
std::vector<RoundPoint> corners_of_group(std::vector<RoundPoint> group) {
  if (group.size() < kLeastGroup) return group;
  const double radius = group.front().radius;
  if (group.front().center.z == group.back().center.z) {
    std::vector<FlatPoint> flat;
    for (const RoundPoint& p : group) flat.push_back({p.center.x, p.center.y});
    const double z = group.front().center.z;
    group.clear();
    for (const FlatPoint& p : flat_hull(std::move(flat))) group.push_back({{p.x, p.y, z}, radius});
    return group;
  }
  std::vector<Vec3> centers;
  for (const RoundPoint& p : group) centers.push_back(p.center);
  const ScadMesh hull = convex_hull(centers);
  if (hull.faces.empty()) return group;
  std::vector<bool> used(group.size(), false);
  for (const auto& face : hull.faces) {
    for (const std::uint32_t i : face) used[i] = true;
  }
  std::vector<RoundPoint> kept;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (used[i]) kept.push_back(group[i]);
  }
  return kept;
}

bool holds(RoundKind kind, const RoundPoint& outer, const RoundPoint& inner, double tolerance) {
  if (kind == RoundKind::kDiscs && std::fabs(outer.center.z - inner.center.z) > tolerance)
    return false;
  return length(outer.center - inner.center) + inner.radius <= outer.radius + tolerance;
}

/// Whether the point is one between two others, or has a smaller radius there.
bool lies_between(const RoundPoint& a, const RoundPoint& b, const RoundPoint& p, double tolerance) {
  const Vec3 d = b.center - a.center, e = p.center - a.center;
  const double share = dot(d, e) / dot(d, d);
  if (!(share > 0 && share < 1)) return false;
  return length(e - share * d) <= tolerance &&
         p.radius <= a.radius + share * (b.radius - a.radius) + tolerance;
}

double extent_of(const std::vector<RoundPoint>& points) {
  double extent = 0;
  for (const RoundPoint& p : points)
    extent = std::max(extent, p.radius + max_abs(p.center - points.front().center));
  return extent;
}

template <typename IsHidden>
void leave_out(std::vector<RoundPoint>& points, const IsHidden& is_hidden) {
  for (std::size_t k = points.size(); k-- > 0;) {
    if (is_hidden(k)) points.erase(points.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

}  // namespace

std::vector<RoundPoint> without_hidden(RoundKind kind, std::vector<RoundPoint> points) {
  if (points.empty()) return points;
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<RoundPoint> kept;
  for (auto begin = points.begin(); begin != points.end();) {
    const auto end = std::find_if(begin, points.end(),
                                  [&](const RoundPoint& p) { return p.radius != begin->radius; });
    for (const RoundPoint& p : corners_of_group({begin, end})) kept.push_back(p);
    begin = end;
  }
  if (kept.size() > kMaxHullPoints) return kept;
  const double tolerance = kRounding * extent_of(kept);
  leave_out(kept, [&](std::size_t k) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (i != k && holds(kind, kept[i], kept[k], tolerance)) return true;
    }
    return false;
  });
  if (kept.size() > kMaxTriplePoints) return kept;
  leave_out(kept, [&](std::size_t k) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      for (std::size_t j = i + 1; j < kept.size(); ++j) {
        if (i != k && j != k && lies_between(kept[i], kept[j], kept[k], tolerance)) return true;
      }
    }
    return false;
  });
  return kept;
}

}  // namespace graycube
