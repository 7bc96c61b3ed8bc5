#include "formats/openscad/hulls/round_ring.hpp"

#include <algorithm>
#include <cmath>

#include "formats/openscad/language/limits.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// A corner of a turned circle is on the axis if it is nearer to it, in radii of the outermost.
constexpr double kOnAxis = 1e-9;

Vec3 turned_corner(const RoundRing& ring, const Vec3& corner, const FlatPoint& p) {
  return ring.center + p.x * (corner - ring.center) + p.y * ring.along;
}

/// The number of `b`'s corner in the place of `a`'s first, and the step, 1 or -1 modulo their
/// number, by which the others follow; false if they don't. Both have equally many.
bool do_corners_agree(const RoundRing& a, const RoundRing& b, double off, std::size_t& begin) {
  const auto are_near = [&](const Vec3& p, const Vec3& q) { return max_abs(p - q) <= off; };
  const std::size_t count = a.corners.size();
  const auto at = std::find_if(b.corners.begin(), b.corners.end(),
                               [&](const Vec3& q) { return are_near(a.corners[0], q); });
  if (at == b.corners.end()) return false;
  begin = static_cast<std::size_t>(at - b.corners.begin());
  for (const std::size_t step : {std::size_t{1}, count - 1}) {
    std::size_t i = 0;
    while (i < count && are_near(a.corners[i], b.corners[(begin + step * i) % count])) ++i;
    if (i == count) return true;
  }
  return false;
}

}  // namespace

RoundRing cylinder_ring(const FlatMap& disk, int sides, const Affine& to_world) {
  RoundRing ring;
  ring.along = normalized(to_world.vector({0, 0, 1}));
  const auto seen = [&](const FlatPoint& p) {
    return across(to_world.point({p.x, p.y, 0}), ring.along);
  };
  ring.center = seen({disk.m[0][2], disk.m[1][2]});
  for (int i = 0; i < sides; ++i) {
    const double angle = 360.0 * i / sides;
    ring.corners.push_back(seen(disk({cos_degrees(angle), sin_degrees(angle)})));
  }
  return ring;
}

RoundRing ball_ring(double radius, int sides, const Affine& to_world) {
  RoundRing ring{RoundRing::Kind::kBall,
                 radius * to_world.vector({0, 0, 1}),
                 to_world.point({0, 0, 0}),
                 {},
                 {}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 360.0 * i / sides;
    ring.corners.push_back(
        to_world.point({radius * cos_degrees(angle), radius * sin_degrees(angle), 0}));
  }
  return ring;
}

RoundRing turned_ring(const FlatLoop& circle, const FlatPoint& center, double radius, int steps,
                      const Affine& to_world) {
  RoundRing ring{RoundRing::Kind::kTurned,
                 radius * to_world.vector({0, 0, 1}),
                 to_world.point({0, 0, center.y}),
                 {},
                 {}};
  const double farthest = center.x < 0 ? center.x - radius : center.x + radius;
  for (int i = 0; i < steps; ++i) {
    // OpenSCAD starts a whole turn on the negative side.
    const double angle = 180 + 360.0 * i / steps;
    ring.corners.push_back(
        to_world.point({farthest * cos_degrees(angle), farthest * sin_degrees(angle), center.y}));
  }
  for (const FlatPoint& p : circle)
    ring.profile.push_back({p.x / farthest, (p.y - center.y) / radius});
  return ring;
}

bool are_one(const RoundRing& a, const RoundRing& b, double share) {
  if (a.kind != b.kind || a.corners.size() != b.corners.size() ||
      a.profile.size() != b.profile.size() || a.corners.empty())
    return false;
  const double off = share * (max_abs(a.center) + length(a.corners[0] - a.center));
  if (!(max_abs(a.center - b.center) <= off)) return false;
  const double turned = a.kind == RoundRing::Kind::kCylinder ? share : off;
  if (max_abs(a.along - b.along) > turned && max_abs(a.along + b.along) > turned) return false;
  std::size_t begin = 0;
  if (!do_corners_agree(a, b, off, begin)) return false;
  if (a.profile.empty()) return true;
  // Regular polygons around one centre are one if they have one corner in common.
  const Vec3 corner = turned_corner(a, a.corners[0], a.profile[0]);
  return std::any_of(b.profile.begin(), b.profile.end(), [&](const FlatPoint& p) {
    return max_abs(turned_corner(b, b.corners[begin], p) - corner) <= off;
  });
}

std::vector<std::vector<Vec3>> edge_lines(const RoundRing& ring) {
  if (ring.kind == RoundRing::Kind::kCylinder) return {ring.corners};
  FlatLoop profile = ring.profile;
  if (ring.kind == RoundRing::Kind::kBall) {
    const std::size_t rings = (ring.corners.size() + 1) / 2;
    for (std::size_t i = 0; i < rings; ++i) {
      const double polar = 180 * (static_cast<double>(i) + 0.5) / static_cast<double>(rings);
      profile.push_back({sin_degrees(polar), cos_degrees(polar)});
    }
  }
  std::vector<std::vector<Vec3>> lines;
  if (profile.size() * ring.corners.size() > kMaxOpenscadFacets) return lines;
  for (const FlatPoint& p : profile) {
    if (!(std::fabs(p.x) > kOnAxis)) continue;
    std::vector<Vec3>& line = lines.emplace_back();
    for (const Vec3& corner : ring.corners) line.push_back(turned_corner(ring, corner, p));
  }
  return lines;
}

}  // namespace graycube
