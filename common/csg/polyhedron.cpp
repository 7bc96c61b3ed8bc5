#include <vector>

#include "csg/half_space.hpp"

namespace graycube::csg {
namespace {

/// A convex polygon in the plane of one face.
using Polygon = std::vector<Vec3>;

/// A square in the plane, `reach` to each side of the point nearest to the origin.
Polygon square_in(const Plane& plane, double reach) {
  const Vec3 n = plane.normal;
  const Vec3 e = std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : std::fabs(n.y) < 0.5 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
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

/// Beyond this multiple of the largest offset a vertex counts as infinitely far: bounds may always be too
/// large, but clipping a larger square would lose the digits of the near vertices.
constexpr double kReach = 1e4;
/// Faces beyond this many make clipping every face by every other too slow; bounds stay infinite.
constexpr std::size_t kMaxClippedFaces = 4096;

}  // namespace

Aabb polyhedron_bounds(std::span<const Plane> faces) {
  if (faces.size() > kMaxClippedFaces) return Aabb::everything();
  double scale = 0;
  for (const Plane& f : faces) scale = std::fmax(scale, std::fabs(f.offset));
  if (scale == 0) scale = 1;
  const double reach = kReach * scale;
  const double margin = 1e-12 * reach;
  Aabb bounds = Aabb::nothing();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Polygon polygon = square_in(faces[i], reach);
    for (std::size_t j = 0; j < faces.size() && !polygon.empty(); ++j) {
      // Of coincident faces each clips the others to nothing or to all; all is wanted.
      if (j != i && !(faces[j] == faces[i])) {
        Plane loose = faces[j];
        loose.offset += margin;
        polygon = clipped(polygon, loose);
      }
    }
    for (const Vec3& v : polygon) bounds.include(v);
  }
  if (bounds.is_empty()) return bounds;
  for (int a = 0; a < 3; ++a) {
    bounds.lo[a] = bounds.lo[a] < -0.5 * reach ? -kInf : bounds.lo[a] - margin;
    bounds.hi[a] = bounds.hi[a] > 0.5 * reach ? kInf : bounds.hi[a] + margin;
  }
  return bounds;
}

}  // namespace graycube::csg
