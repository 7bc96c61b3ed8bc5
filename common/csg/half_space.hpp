// Half-spaces, and convex polyhedra as intersections of them. Normals are unit.
#pragma once

#include <span>
#include <vector>

#include "csg/roots.hpp"

namespace graycube::csg {

inline Slots half_space_slots(const Plane& plane) {
  return {plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, 0, 0};
}
inline Plane half_space_plane(const Slots& v) { return {{v[0], v[1], v[2]}, v[3]}; }
inline Plane half_space_plane(const Primitive& p) { return half_space_plane(p.v); }

inline std::span<const Plane> faces_of(const Primitive& p, std::span<const Plane> planes) {
  return planes.subspan(p.first_plane, p.plane_count);
}

/// The least (or, negated, the greatest) value of normal · q over a box, which may be unbounded.
inline double least_along(const Vec3& normal, const Aabb& box) {
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    if (normal[a] > 0) sum += normal[a] * box.lo[a];
    if (normal[a] < 0) sum += normal[a] * box.hi[a];
  }
  return sum;
}
inline double greatest_along(const Vec3& normal, const Aabb& box) {
  return -least_along(-normal, box);
}

inline CellSide classify_plane(const Plane& plane, const Aabb& cell) {
  if (least_along(plane.normal, cell) > plane.offset) return CellSide::kOutside;
  return greatest_along(plane.normal, cell) < plane.offset ? CellSide::kInside : CellSide::kCrosses;
}

inline Spans half_space_spans(const Primitive& p, const Ray& ray) {
  const Plane f = half_space_plane(p);
  Interval i;
  clip_to_half_space(i, f.offset, dot(f.normal, ray.origin), dot(f.normal, ray.direction));
  return spans_of(i);
}
inline bool half_space_contains(const Primitive& p, const Vec3& q) {
  const Plane f = half_space_plane(p);
  return dot(f.normal, q) <= f.offset;
}

inline Vec3 half_space_normal(const Primitive& p, const Ray&, double) {
  return half_space_plane(p).normal;
}
inline CellSide classify_half_space(const Primitive& p, const Aabb& cell) {
  return classify_plane(half_space_plane(p), cell);
}
inline bool move_half_space(Primitive& p, double by) {
  p.v[3] += by;
  return true;
}

inline Spans polyhedron_spans(std::span<const Plane> faces, const Ray& ray) {
  Interval i;
  for (const Plane& f : faces) {
    clip_to_half_space(i, f.offset, dot(f.normal, ray.origin), dot(f.normal, ray.direction));
    if (i.is_empty()) return {};
  }
  return spans_of(i);
}
inline bool polyhedron_contains(std::span<const Plane> faces, const Vec3& q) {
  for (const Plane& f : faces) {
    if (dot(f.normal, q) > f.offset) return false;
  }
  return true;
}
/// The normal of the first face that the ray crosses at parameter t.
inline Vec3 polyhedron_normal(std::span<const Plane> faces, const Ray& ray, double t) {
  for (const Plane& f : faces) {
    if (is_on_plane(f.offset, dot(f.normal, ray.origin), dot(f.normal, ray.direction), t)) {
      return f.normal;
    }
  }
  return {};
}
inline CellSide classify_polyhedron(const Primitive& p, std::span<const Plane> faces,
                                    const Aabb& cell) {
  if (!cell.overlaps(p.bounds)) return CellSide::kOutside;
  bool inside = true;
  for (const Plane& f : faces) {
    const CellSide side = classify_plane(f, cell);
    if (side == CellSide::kOutside) return side;
    inside = inside && side == CellSide::kInside;
  }
  return inside ? CellSide::kInside : CellSide::kCrosses;
}

/// Appends the moved planes to `planes`.
inline bool move_polyhedron(Primitive& p, std::span<const Plane> faces, double by,
                            std::vector<Plane>& planes) {
  p.first_plane = static_cast<std::uint32_t>(planes.size());
  for (const Plane& f : faces) planes.push_back({f.normal, f.offset + by});
  return true;
}

/// Bounds of a half-space: infinite except for one across a world axis.
Aabb half_space_bounds(const Plane& plane);

/// Bounds of the intersection of the half-spaces. When it is unbounded, or a vertex lies farther
/// out than some thousand times the largest offset, only faces across a world axis bound it.
Aabb polyhedron_bounds(std::span<const Plane> faces);

}  // namespace graycube::csg
