#include <algorithm>
#include <cmath>
#include <vector>

#include "csg/half_space.hpp"

namespace graycube::csg {
namespace {

/// A convex polygon in the plane of one face.
using Polygon = std::vector<Vec3>;

/// A square in the plane, `reach` to each side of the point nearest to the origin.
Polygon square_in(const Plane& plane, double reach) {
  const Vec3 n = plane.normal;
  const Vec3 e = std::fabs(n.x) < 0.5   ? Vec3{1, 0, 0}
                 : std::fabs(n.y) < 0.5 ? Vec3{0, 1, 0}
                                        : Vec3{0, 0, 1};
  const Vec3 u = reach * normalized(cross(n, e));
  const Vec3 w = cross(n, u);
  const Vec3 c = plane.offset * n;
  return {c + u + w, c + w - u, c - u - w, c + u - w};
}

/// Keeps the part of the polygon with normal · p ≤ offset (Sutherland & Hodgman 1974).
Polygon clipped(const Polygon& polygon, const Plane& plane) {
  Polygon r;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double fa = dot(plane.normal, a) - plane.offset;
    const double fb = dot(plane.normal, b) - plane.offset;
    if (fa <= 0) r.push_back(a);
    if ((fa < 0 && fb > 0) || (fa > 0 && fb < 0)) r.push_back(a + (fa / (fa - fb)) * (b - a));
  }
  return r;
}

/// Beyond half this multiple of the largest offset a vertex counts as infinitely far: bounds may
/// always be too large, but clipping a larger square would lose the digits of the near vertices.
constexpr double kReach = 1e4;
/// With more faces, clipping every one by every other takes too long, and bounds are those of about
/// as many that matter most.
constexpr std::size_t kMaxClippedFaces = 256;
constexpr int kMaxRounds = 20;

/// The bounds that the faces across the world axes alone imply; infinite elsewhere.
Aabb bounds_of_axis_faces(std::span<const Plane> faces) {
  Aabb bounds;
  for (const Plane& f : faces) {
    for (int a = 0; a < 3; ++a) {
      if (f.normal[(a + 1) % 3] != 0 || f.normal[(a + 2) % 3] != 0) continue;
      if (f.normal[a] > 0) bounds.hi[a] = std::fmin(bounds.hi[a], f.offset);
      if (f.normal[a] < 0) bounds.lo[a] = std::fmax(bounds.lo[a], -f.offset);
    }
  }
  return bounds;
}

/// The corners of the solid, each several times, and of squares where it reaches farther than
/// `reach`. Faces may be off by the margin.
Polygon corners_of(std::span<const Plane> faces, double reach, double margin) {
  Polygon corners;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Polygon polygon = square_in(faces[i], reach);
    for (std::size_t j = 0; j < faces.size() && !polygon.empty(); ++j) {
      // Coincident faces would clip one another to nothing or to all; all is wanted.
      if (j != i && !(faces[j] == faces[i])) {
        Plane loose = faces[j];
        loose.offset += margin;
        polygon = clipped(polygon, loose);
      }
    }
    corners.insert(corners.end(), polygon.begin(), polygon.end());
  }
  return corners;
}

/// Faces evenly through the list, half as many as are clipped.
std::vector<Plane> some_of(std::span<const Plane> faces) {
  std::vector<Plane> some;
  constexpr std::size_t kCount = kMaxClippedFaces / 2;
  for (std::size_t i = 0; i < kCount; ++i) some.push_back(faces[i * faces.size() / kCount]);
  return some;
}

/// Adds the faces that cut off most of the corners that are outermost along the world axes; false
/// if none does.
bool add_missed(std::span<const Plane> faces, std::span<const Vec3> corners, double margin,
                std::vector<Plane>& chosen) {
  bool has_added = false;
  for (int side = 0; side < 6 && !corners.empty(); ++side) {
    const auto along = [&](const Vec3& v) { return side < 3 ? v[side] : -v[side - 3]; };
    const Vec3 outermost =
        *std::max_element(corners.begin(), corners.end(),
                          [&](const Vec3& a, const Vec3& b) { return along(a) < along(b); });
    const auto beyond = [&](const Plane& f) { return dot(f.normal, outermost) - f.offset; };
    const Plane missed =
        *std::max_element(faces.begin(), faces.end(),
                          [&](const Plane& a, const Plane& b) { return beyond(a) < beyond(b); });
    if (!(beyond(missed) > 2 * margin)) continue;
    chosen.push_back(missed);
    has_added = true;
  }
  return has_added;
}

}  // namespace

Aabb half_space_bounds(const Plane& plane) {
  Aabb b;
  const Vec3& n = plane.normal;
  for (int a = 0; a < 3; ++a) {
    if (n[a] == 0 || n[(a + 1) % 3] != 0 || n[(a + 2) % 3] != 0) continue;
    (n[a] > 0 ? b.hi[a] : b.lo[a]) = plane.offset / n[a];
  }
  return b;
}

Aabb polyhedron_bounds(std::span<const Plane> faces) {
  const Aabb unclipped = bounds_of_axis_faces(faces);
  double scale = 0;
  for (const Plane& f : faces) scale = std::fmax(scale, std::fabs(f.offset));
  if (scale == 0) scale = 1;
  const double reach = kReach * scale;
  const double margin = 1e-12 * reach;
  Polygon corners;
  if (faces.size() <= kMaxClippedFaces) {
    corners = corners_of(faces, reach, margin);
  } else {
    // Without some of its faces the solid is larger, and so are its bounds.
    std::vector<Plane> chosen = some_of(faces);
    corners = corners_of(chosen, reach, margin);
    for (int round = 0; round < kMaxRounds && add_missed(faces, corners, margin, chosen); ++round)
      corners = corners_of(chosen, reach, margin);
  }
  Aabb bounds = Aabb::nothing();
  for (const Vec3& v : corners) {
    // An unbounded solid may reach farther than its clipped faces in any direction, a half-space
    // at once.
    if (max_abs(v) > 0.5 * reach) return unclipped;
    bounds.include(v);
  }
  // No face within reach: the solid is empty, or all of it is farther away.
  return bounds.is_empty() ? unclipped : bounds.grown(margin);
}

}  // namespace graycube::csg
