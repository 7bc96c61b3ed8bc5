#include "mesh/cut_face.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/delaunay_flips.hpp"
#include "mesh/ear_cut.hpp"
#include "mesh/face_point.hpp"
#include "mesh/monotone_cut.hpp"

namespace graycube {
namespace {

/// A face counts as flat if no corner is further from its plane than this part of its extent:
/// corners of flat faces are off by that much once they are written with six digits.
constexpr double kFlatWithin = 4e-6;

Vec3 newell_normal(std::span<const Vec3> points, std::span<const std::uint32_t> face) {
  Vec3 normal;
  const Vec3 middle = points[face.front()];
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 a = points[face[i]] - middle;
    const Vec3 b = points[face[(i + 1) % face.size()]] - middle;
    normal = normal + cross(a, b);
  }
  return normal;
}

int longest_axis(const Vec3& v) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::fabs(v[a]) > std::fabs(v[axis])) axis = a;
  }
  return axis;
}

/// The face's corners, seen along an axis from the side from which it turns counterclockwise.
std::vector<FacePoint> flattened(std::span<const Vec3> points, std::span<const std::uint32_t> face,
                                 const Vec3& normal) {
  const int axis = longest_axis(normal);
  const bool is_above = normal[axis] >= 0;
  const int u = (axis + (is_above ? 1 : 2)) % 3, v = (axis + (is_above ? 2 : 1)) % 3;
  std::vector<FacePoint> flat;
  flat.reserve(face.size());
  for (const std::uint32_t i : face) flat.push_back({points[i][u], points[i][v]});
  return flat;
}

/// Whether the face is bent by more than rounding. One without an area is not.
bool is_bent(std::span<const Vec3> points, std::span<const std::uint32_t> face,
             const Vec3& normal) {
  const double area = length(normal);
  if (!(area > 0) || !std::isfinite(area)) return false;
  const Vec3 first = points[face.front()];
  double extent = 0, lowest = 0, highest = 0;
  for (const std::uint32_t i : face) {
    const Vec3 d = points[i] - first;
    const double height = dot(d, normal) / area;
    extent = std::max(extent, max_abs(d));
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return highest - lowest > kFlatWithin * extent;
}

/// The direction along which OpenSCAD looks at a bent face to cut it: across the longest of the
/// face's three extents and the corner that is furthest from it. Of equal ones the last counts, as
/// libtess2 has its corners in that order.
Vec3 widest_normal(std::span<const Vec3> corners) {
  std::array<Vec3, 3> low, high;
  low.fill(corners.back());
  high = low;
  for (auto p = corners.rbegin(); p != corners.rend(); ++p) {
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      if ((*p)[a] < low[k][a]) low[k] = *p;
      if ((*p)[a] > high[k][a]) high[k] = *p;
    }
  }
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    const auto extent = [&](std::size_t i) {
      const int a = static_cast<int>(i);
      return high[i][a] - low[i][a];
    };
    if (extent(k) > extent(longest)) longest = k;
  }
  Vec3 widest;
  const Vec3 line = low[longest] - high[longest];
  for (auto p = corners.rbegin(); p != corners.rend(); ++p) {
    const Vec3 normal = cross(line, *p - high[longest]);
    if (dot(normal, normal) > dot(widest, widest)) widest = normal;
  }
  return widest;
}

/// The corner with single precision, in which OpenSCAD cuts faces, unless it is out of its range.
Vec3 rounded(Vec3 p) {
  for (int a = 0; a < 3; ++a) {
    const auto single = static_cast<float>(p[a]);
    if (std::isfinite(single)) p[a] = single;
  }
  return p;
}

/// A bent face's corners along the two axes across the longest one of its normal, in their order;
/// turned over, if need be, so that it turns counterclockwise.
std::vector<FacePoint> flattened_bent(std::span<const Vec3> points,
                                      std::span<const std::uint32_t> face) {
  std::vector<Vec3> corners;
  for (const std::uint32_t i : face) corners.push_back(rounded(points[i]));
  const int axis = longest_axis(widest_normal(corners));
  std::vector<FacePoint> flat;
  for (const Vec3& p : corners) flat.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
  double area = 0;
  for (std::size_t i = 2; i < flat.size(); ++i) area += turn(flat[0], flat[i - 1], flat[i]);
  if (area < 0) {
    for (FacePoint& p : flat) p.y = -p.y;
  }
  return flat;
}

/// Whether every corner turns left, and all together go around once.
bool is_convex(std::span<const FacePoint> flat) {
  const std::size_t n = flat.size();
  std::size_t reversals = 0;
  bool rose = flat[0].x > flat[n - 1].x;
  for (std::size_t i = 0; i < n; ++i) {
    const FacePoint& a = flat[i];
    const FacePoint& b = flat[(i + 1) % n];
    if (!(turn(a, b, flat[(i + 2) % n]) > 0)) return false;
    const bool rises = b.x > a.x;
    if (rises != rose) ++reversals;
    rose = rises;
  }
  return reversals <= 2;
}

/// Makes the triangles' numbers of the face's corners numbers of points.
void name_corners(std::span<Triangle> triangles, std::span<const std::uint32_t> face) {
  for (Triangle& t : triangles) {
    for (std::uint32_t& corner : t) corner = face[corner];
  }
}

/// What the surface is depends on where a bent face is cut.
void cut_bent(std::span<const Vec3> points, std::span<const std::uint32_t> face,
              std::vector<Triangle>& triangles) {
  const std::vector<FacePoint> flat = flattened_bent(points, face);
  const std::size_t first = triangles.size();
  if (!cut_monotone(flat, triangles)) cut_ears(flat, triangles);
  const std::span<Triangle> own = std::span(triangles).subspan(first);
  flip_to_delaunay(flat, own);
  name_corners(own, face);
}

}  // namespace

void cut_face(std::span<const Vec3> points, std::span<const std::uint32_t> face, FaceSide side,
              std::vector<Triangle>& triangles) {
  if (face.size() == 3) {
    triangles.push_back({face[0], face[1], face[2]});
    return;
  }
  const Vec3 normal = newell_normal(points, face);
  if (is_bent(points, face, normal)) {
    if (side == FaceSide::kOuter) return cut_bent(points, face, triangles);
    const std::size_t first = triangles.size();
    cut_bent(points, std::vector<std::uint32_t>(face.rbegin(), face.rend()), triangles);
    for (std::size_t i = first; i < triangles.size(); ++i)
      std::swap(triangles[i][1], triangles[i][2]);
    return;
  }
  const std::vector<FacePoint> flat = flattened(points, face, normal);
  if (is_convex(flat)) {
    for (std::size_t i = 2; i < face.size(); ++i)
      triangles.push_back({face[0], face[i - 1], face[i]});
    return;
  }
  const std::size_t first = triangles.size();
  cut_ears(flat, triangles);
  name_corners(std::span(triangles).subspan(first), face);
}

}  // namespace graycube
