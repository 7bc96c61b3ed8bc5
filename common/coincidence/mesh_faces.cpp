#include "coincidence/mesh_faces.hpp"

#include <algorithm>
#include <cmath>

namespace graycube::csg {
namespace {

/// Primitives times meshes that are compared by their bounds; beyond it all triangles count as
/// near.
constexpr std::size_t kMostComparisons = std::size_t{1} << 22;

Aabb touched_part(const Model& model, std::uint32_t primitive, double tolerance) {
  const Aabb own = model.primitives[primitive].bounds.grown(2 * tolerance);
  if (model.primitives.size() * model.meshes.size() > kMostComparisons) return own;
  Aabb touched = Aabb::nothing();
  for (std::uint32_t i = 0; i < model.primitives.size(); ++i) {
    if (i == primitive) continue;
    const Aabb common = intersection_of(own, model.primitives[i].bounds);
    if (!common.is_empty()) touched = union_of(touched, common);
  }
  return touched.is_empty() ? touched : touched.grown(2 * tolerance);
}

}  // namespace

MeshFaces::MeshFaces(const Model& model, std::uint32_t primitive, const Exactness& exactness)
    : mesh_(model.meshes[model.primitives[primitive].mesh]),
      primitive_(primitive),
      exactness_(exactness),
      near_(touched_part(model, primitive, exactness.distance())) {}

bool MeshFaces::is_near(std::uint32_t triangle) const {
  Aabb box = Aabb::nothing();
  for (const std::uint32_t corner : surface().triangles[triangle])
    box.include(surface().points[corner]);
  return box.overlaps(near_);
}

MeshFace MeshFaces::face(std::uint32_t triangle) const {
  const Triangle& t = surface().triangles[triangle];
  const Vec3 &a = surface().points[t[0]], &b = surface().points[t[1]], &c = surface().points[t[2]];
  const Vec3 normal = cross(b - a, c - a);
  const double longest = std::max(length(b - a), std::max(length(c - b), length(a - c)));
  const double height = length(normal) / longest;
  MeshFace f;
  f.plane.normal = normalized(normal) + Vec3{};
  f.middle = (1.0 / 3) * (a + b + c);
  f.plane.offset = dot(f.plane.normal, a) + 0.0;
  // NaN, of a triangle without an area, is no direction either.
  const double turned = exactness_.distance() / height;
  f.direction_tolerance = turned <= 1 ? exactness_.direction + turned : 1.0;
  return f;
}

bool MeshFaces::lies_in(std::uint32_t triangle, const Plane& plane) const {
  const double tolerance = 2 * exactness_.distance();
  for (const std::uint32_t corner : surface().triangles[triangle]) {
    if (!(std::fabs(dot(plane.normal, surface().points[corner]) - plane.offset) <= tolerance))
      return false;
  }
  return true;
}

void MeshFaces::set(std::uint32_t triangle, const Plane& plane) {
  if (!lies_in(triangle, plane)) return;
  if (plane_of_.empty()) plane_of_.assign(surface().triangles.size(), TriangleMesh::kOwnPlane);
  // Triangles of one plane come one after the other.
  if (planes_.empty() || !(planes_.back() == plane)) planes_.push_back(plane);
  plane_of_[triangle] = static_cast<std::uint32_t>(planes_.size() - 1);
}

void MeshFaces::spread_to_slender() {
  /// Corners with planes of triangles there.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> planes_at;
  const auto& triangles = surface().triangles;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (plane_of_[i] == TriangleMesh::kOwnPlane) continue;
    for (const std::uint32_t corner : triangles[i]) planes_at.emplace_back(corner, plane_of_[i]);
  }
  std::sort(planes_at.begin(), planes_at.end());
  planes_at.erase(std::unique(planes_at.begin(), planes_at.end()), planes_at.end());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (plane_of_[i] != TriangleMesh::kOwnPlane || face(i).direction_tolerance <= kWorstDirection)
      continue;
    const std::uint32_t corner = triangles[i][0];
    auto at =
        std::lower_bound(planes_at.begin(), planes_at.end(), std::pair(corner, std::uint32_t{0}));
    for (; at != planes_at.end() && at->first == corner; ++at) {
      if (!lies_in(i, planes_[at->second])) continue;
      plane_of_[i] = at->second;
      break;
    }
  }
}

bool MeshFaces::settle(Model& model) {
  if (planes_.empty()) return false;
  spread_to_slender();
  TriangleMesh with_planes = surface();
  with_planes.planes = std::move(planes_);
  with_planes.plane_of = std::move(plane_of_);
  Primitive& p = model.primitives[primitive_];
  model.meshes[p.mesh] = Mesh(std::move(with_planes));
  p.bounds = model.meshes[p.mesh].bounds();
  return true;
}

}  // namespace graycube::csg
