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
/// Faces beyond this many make clipping every face by every other too slow; bounds stay infinite.
constexpr std::size_t kMaxClippedFaces = 4096;

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
  if (faces.size() > kMaxClippedFaces) return unclipped;
  double scale = 0;
  for (const Plane& f : faces) scale = std::fmax(scale, std::fabs(f.offset));
  if (scale == 0) scale = 1;
  const double reach = kReach * scale;
  const double margin = 1e-12 * reach;
  Aabb bounds = Aabb::nothing();
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
    for (const Vec3& v : polygon) {
      // An unbounded solid may reach farther than its clipped faces in any direction, a half-space
      // at once.
      if (max_abs(v) > 0.5 * reach) return unclipped;
      bounds.include(v);
    }
  }
  // No face within reach: the solid is empty, or all of it is farther away.
  return bounds.is_empty() ? unclipped : bounds.grown(margin);
}

}  // namespace graycube::csg
