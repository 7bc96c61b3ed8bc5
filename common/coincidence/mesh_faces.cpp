#include "coincidence/mesh_faces.hpp"

#include <algorithm>
#include <cmath>

namespace graycube::csg {
namespace {

/// The most primitives times meshes that are compared by their bounds; beyond it all triangles
/// count as near.
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

/// The triangles near other primitives.
std::vector<std::uint32_t> touched_triangles(const TriangleMesh& mesh, const Aabb& touched) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Aabb box = Aabb::nothing();
    for (const std::uint32_t corner : mesh.triangles[i]) box.include(mesh.points[corner]);
    if (box.overlaps(touched)) near.push_back(i);
  }
  return near;
}

}  // namespace

MeshFaces::MeshFaces(const Model& model, std::uint32_t primitive, const Exactness& exactness)
    : mesh_(model.meshes[model.primitives[primitive].mesh]),
      primitive_(primitive),
      exactness_(exactness),
      flats_(surface(),
             touched_triangles(surface(), touched_part(model, primitive, exactness.distance())),
             exactness.distance()) {}

MeshFace MeshFaces::face(std::uint32_t number) const {
  const Flat& flat = flats_.flats()[number];
  // NaN, which triangles without an area give, counts as no known direction either.
  const double turned = exactness_.distance() / flat.width;
  return {flat.plane, flat.middle, turned <= 1 ? exactness_.direction + turned : 1.0};
}

bool MeshFaces::lies_in(std::uint32_t triangle, const Plane& plane) const {
  const double tolerance = 2 * exactness_.distance();
  for (const std::uint32_t corner : surface().triangles[triangle]) {
    if (!(std::fabs(dot(plane.normal, surface().points[corner]) - plane.offset) <= tolerance))
      return false;
  }
  return true;
}

void MeshFaces::set(std::uint32_t number, const Plane& plane) {
  bool is_used = false;
  for (const std::uint32_t triangle : flats_.triangles_of(flats_.flats()[number])) {
    if (!lies_in(triangle, plane)) continue;
    if (plane_of_.empty()) plane_of_.assign(surface().triangles.size(), TriangleMesh::kOwnPlane);
    plane_of_[triangle] = static_cast<std::uint32_t>(planes_.size());
    is_used = true;
  }
  if (is_used) planes_.push_back(plane);
}

bool MeshFaces::settle(Model& model) {
  if (planes_.empty()) return false;
  TriangleMesh with_planes = surface();
  with_planes.planes = std::move(planes_);
  with_planes.plane_of = std::move(plane_of_);
  Primitive& p = model.primitives[primitive_];
  model.meshes[p.mesh] = Mesh(std::move(with_planes));
  p.bounds = model.meshes[p.mesh].bounds();
  return true;
}

}  // namespace graycube::csg
