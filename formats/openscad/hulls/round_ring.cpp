#include "formats/openscad/hulls/round_ring.hpp"

#include <algorithm>
#include <cmath>

#include "formats/openscad/language/limits.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// A corner of a turned outline is on the axis if it is nearer to it, in radii of the outermost.
constexpr double kOnAxis = 1e-9;
/// How far from a whole number of steps a turn of 360° may be.
constexpr double kWholeSteps = 1e-9;

Vec3 turned_corner(const RoundRing& ring, const Vec3& corner, const FlatPoint& p) {
  return ring.center + p.x * (corner - ring.center) + p.y * ring.along;
}

/// Whether the corners of two closed lines, or of open ones, are the same, either way round.
/// `begin`: the number of b's corner in the place of a's first.
bool do_corners_agree(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double off,
                      std::size_t& begin) {
  const auto are_near = [&](const Vec3& p, const Vec3& q) { return max_abs(p - q) <= off; };
  const std::size_t count = a.size();
  if (count != b.size() || count == 0) return false;
  const auto at =
      std::find_if(b.begin(), b.end(), [&](const Vec3& q) { return are_near(a[0], q); });
  if (at == b.end()) return false;
  begin = static_cast<std::size_t>(at - b.begin());
  for (const std::size_t step : {std::size_t{1}, count - 1}) {
    std::size_t i = 0;
    while (i < count && are_near(a[i], b[(begin + step * i) % count])) ++i;
    if (i == count) return true;
  }
  return false;
}

/// How far its numbers may be off.
double off_of(const RoundRing& ring, double share) {
  return share * (max_abs(ring.center) + length(ring.corners[0] - ring.center));
}

/// A cone's corner on the way to the other end.
Vec3 on_cone(const RoundRing& cone, const Vec3& corner, double height) {
  return cone.center + height * cone.along + (1 - height * cone.narrowing) * (corner - cone.center);
}

/// Whether two cones have the same lines along their facets' edges, wherever they end.
bool are_one_cone(const RoundRing& a, const RoundRing& b, double share) {
  const double reach = length(a.along) + length(a.corners[0] - a.center);
  const double side = length(a.corners[1] - a.corners[0]);
  // A cone may end in its tip.
  for (const double height : {0.0, 0.5}) {
    const SeenPoint first = seen_by(a, on_cone(b, b.corners[0], height));
    const double off = (off_of(a, share) + share * std::fabs(first.height) * reach) / first.size;
    const bool has_first = std::any_of(a.corners.begin(), a.corners.end(), [&](const Vec3& corner) {
      return max_abs(corner - first.place) <= off;
    });
    if (!(first.size > 0 && off < side) || !has_first) return false;
    std::vector<Vec3> seen;
    for (const Vec3& corner : b.corners)
      seen.push_back(seen_by(a, on_cone(b, corner, height)).place);
    std::size_t begin = 0;
    if (!do_corners_agree(a.corners, seen, off, begin)) return false;
  }
  return true;
}

/// Whether the outlines that are turned are the same, if `b`'s corner in the place of a's first is
/// the one of this number.
bool are_profiles_one(const RoundRing& a, const RoundRing& b, std::size_t corner, double off) {
  const auto placed = [](const RoundRing& ring, const Vec3& outermost) {
    std::vector<Vec3> places;
    for (const FlatPoint& p : ring.profile) places.push_back(turned_corner(ring, outermost, p));
    return places;
  };
  std::size_t begin = 0;
  return do_corners_agree(placed(a, a.corners[0]), placed(b, b.corners[corner]), off, begin);
}

}  // namespace

RingAngles whole_ring(int sides, double start) {
  RingAngles angles;
  for (int i = 0; i < sides; ++i) angles.degrees.push_back(start + 360.0 * i / sides);
  return angles;
}

RingAngles turn_ring(double start, double angle, int steps) {
  const double around = 360 * steps / std::fabs(angle), sides = std::round(around);
  if (sides <= kMaxOpenscadSides && std::fabs(around - sides) <= kWholeSteps * sides)
    return whole_ring(static_cast<int>(sides), start);
  RingAngles angles;
  angles.is_open = true;
  for (int i = 0; i <= steps; ++i) angles.degrees.push_back(start + angle * i / steps);
  return angles;
}

RoundRing cylinder_ring(const FlatMap& disk, const RingAngles& angles, const Affine& to_world) {
  RoundRing ring;
  ring.along = normalized(to_world.vector({0, 0, 1}));
  ring.is_open = angles.is_open;
  const auto seen = [&](const FlatPoint& p) {
    return across(to_world.point({p.x, p.y, 0}), ring.along);
  };
  ring.center = seen({disk.m[0][2], disk.m[1][2]});
  for (const double angle : angles.degrees)
    ring.corners.push_back(seen(disk({cos_degrees(angle), sin_degrees(angle)})));
  return ring;
}

RoundRing cone_ring(const FlatMap& disk, double wide_z, const Vec3& narrow, double ratio,
                    const RingAngles& angles, const Affine& to_world) {
  RoundRing ring;
  ring.kind = RoundRing::Kind::kCone;
  ring.is_open = angles.is_open;
  ring.narrowing = 1 - ratio;
  ring.center = to_world.point({disk.m[0][2], disk.m[1][2], wide_z});
  ring.along = to_world.point(narrow) - ring.center;
  const Vec3 level = cross(to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0}));
  ring.normal = (1 / dot(level, ring.along)) * level;
  for (const double angle : angles.degrees) {
    const FlatPoint p = disk({cos_degrees(angle), sin_degrees(angle)});
    ring.corners.push_back(to_world.point({p.x, p.y, wide_z}));
  }
  return ring;
}

RoundRing ball_ring(double radius, int sides, const Affine& to_world) {
  RoundRing ring;
  ring.kind = RoundRing::Kind::kBall;
  ring.along = radius * to_world.vector({0, 0, 1});
  ring.center = to_world.point({0, 0, 0});
  for (const double angle : whole_ring(sides).degrees) {
    ring.corners.push_back(
        to_world.point({radius * cos_degrees(angle), radius * sin_degrees(angle), 0}));
  }
  return ring;
}

RoundRing turned_ring(const FlatLoop& outline, const FlatPoint& center, const FlatPoint& reach,
                      const RingAngles& angles, const Affine& to_world) {
  RoundRing ring;
  ring.kind = RoundRing::Kind::kTurned;
  ring.is_open = angles.is_open;
  ring.along = reach.y * to_world.vector({0, 0, 1});
  ring.center = to_world.point({0, 0, center.y});
  const double farthest = center.x < 0 ? center.x - reach.x : center.x + reach.x;
  for (const double angle : angles.degrees) {
    ring.corners.push_back(
        to_world.point({farthest * cos_degrees(angle), farthest * sin_degrees(angle), center.y}));
  }
  for (const FlatPoint& p : outline)
    ring.profile.push_back({p.x / farthest, (p.y - center.y) / reach.y});
  return ring;
}

bool are_one(const RoundRing& a, const RoundRing& b, double share) {
  if (a.kind != b.kind || a.corners.size() != b.corners.size() || a.is_open != b.is_open ||
      a.profile.size() != b.profile.size() || a.corners.size() < 2)
    return false;
  if (a.kind == RoundRing::Kind::kCone) return are_one_cone(a, b, share);
  const double off = off_of(a, share);
  if (!(max_abs(a.center - b.center) <= off)) return false;
  const double turned = a.kind == RoundRing::Kind::kCylinder ? share : off;
  if (max_abs(a.along - b.along) > turned && max_abs(a.along + b.along) > turned) return false;
  std::size_t begin = 0;
  if (!do_corners_agree(a.corners, b.corners, off, begin)) return false;
  return a.profile.empty() || are_profiles_one(a, b, begin, off);
}

SeenPoint seen_by(const RoundRing& ring, const Vec3& point) {
  if (ring.kind == RoundRing::Kind::kCylinder) return {across(point, ring.along), 1, 0};
  if (ring.kind != RoundRing::Kind::kCone) return {point, 1, 0};
  const Vec3 away = point - ring.center;
  const double height = dot(ring.normal, away), size = 1 - ring.narrowing * height;
  return {ring.center + (1 / size) * (away - height * ring.along), size, height};
}

std::vector<std::vector<Vec3>> edge_lines(const RoundRing& ring) {
  if (ring.kind == RoundRing::Kind::kCylinder || ring.kind == RoundRing::Kind::kCone)
    return {ring.corners};
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
