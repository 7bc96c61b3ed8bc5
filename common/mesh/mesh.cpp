#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/interval.hpp"
#include "mesh/tree.hpp"

namespace graycube {

struct Mesh::Data {
  explicit Data(TriangleMesh mesh) : surface(std::move(mesh)), tree(surface) {
    for (const Vec3& p : surface.points) bounds.include(p);
    for (std::size_t i = 0; i < surface.plane_of.size(); ++i) {
      if (surface.plane_of[i] == TriangleMesh::kOwnPlane) continue;
      const Plane& plane = surface.planes[surface.plane_of[i]];
      for (const std::uint32_t corner : surface.triangles[i]) {
        bounds.include(nearest_on(plane, surface.points[corner]));
      }
    }
  }

  TriangleMesh surface;
  MeshTree tree;
  Aabb bounds = Aabb::nothing();
};

namespace {

/// The spans inside the surface, from sorted cuts and the winding number before the first of them.
Spans spans_of(const std::vector<MeshCut>& cuts, std::int32_t winding) {
  Spans spans;
  double entered = -kInf;
  for (std::size_t i = 0; i < cuts.size();) {
    const double t = cuts[i].t;
    const bool was_inside = winding != 0;
    for (; i < cuts.size() && cuts[i].t == t; ++i) winding += cuts[i].count;
    if ((winding != 0) == was_inside) continue;
    if (was_inside) {
      spans.add(entered, t);
    } else {
      entered = t;
    }
  }
  if (winding != 0) spans.add(entered, kInf);  // only of an open mesh
  return spans;
}

bool is_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace

Mesh::Mesh() {
  static const auto nothing = std::make_shared<const Data>(TriangleMesh{});
  data_ = nothing;
}
Mesh::Mesh(TriangleMesh surface) : data_(std::make_shared<const Data>(std::move(surface))) {}

const TriangleMesh& Mesh::surface() const { return data_->surface; }
const Aabb& Mesh::bounds() const { return data_->bounds; }
const MeshTree& Mesh::tree() const { return data_->tree; }

std::size_t Mesh::memory_bytes() const {
  return sizeof(Data) + data_->surface.points.size() * sizeof(Vec3) +
         data_->surface.triangles.size() * sizeof(Triangle) +
         data_->surface.planes.size() * sizeof(Plane) +
         data_->surface.plane_of.size() * sizeof(std::uint32_t) + data_->tree.memory_bytes();
}

void Mesh::sort_by_parameter(std::vector<MeshCut>& cuts) {
  if (cuts.size() < 2) return;
  std::sort(cuts.begin(), cuts.end(), [](const MeshCut& a, const MeshCut& b) { return a.t < b.t; });
}

bool Mesh::is_before_bounds(const Ray& ray, double t) const {
  // Far larger than the rounding errors of the bounds and of the parameters of cuts in them.
  constexpr double kShare = 1e-6;
  const Aabb& box = data_->bounds;
  double enter = -kInf;
  for (int a = 0; a < 3; ++a) {
    if (ray.direction[a] == 0) continue;
    const double margin = kShare * (max_abs(box.lo) + max_abs(box.hi) + max_abs(ray.origin));
    const double at = ray.direction[a] > 0 ? box.lo[a] - margin : box.hi[a] + margin;
    const double reached = (at - ray.origin[a]) / ray.direction[a];
    if (reached > enter) enter = reached;
  }
  return t < enter;
}

void Mesh::cuts_ahead(const Ray& ray, double from, std::vector<MeshCut>& cuts) const {
  cuts_between(ray, from, kInf, cuts);
}

void Mesh::cuts_between(const Ray& ray, double from, double below,
                        std::vector<MeshCut>& cuts) const {
  cuts.clear();
  add_cuts(data_->tree, csg::MeshLine(ray), ray, from, below, cuts);
  sort_by_parameter(cuts);
}

Spans Mesh::spans(const Ray& ray) const {
  std::vector<MeshCut> cuts;
  const csg::MeshLine line(ray);
  add_cuts(data_->tree, line, ray, -kInf, 0, cuts);
  add_cuts(data_->tree, line, ray, 0, kInf, cuts);
  sort_by_parameter(cuts);
  return spans_of(cuts, 0);
}

Spans Mesh::spans_ahead(const Ray& ray, std::vector<MeshCut>& cuts) const {
  cuts_ahead(ray, 0, cuts);
  return spans_of(cuts, winding_before(cuts));
}

bool Mesh::contains(const Vec3& point) const {
  // The direction is along no plane that a model is likely to have.
  const Ray ray{point, {0.36154797, 0.48223431, 0.79794753}};
  std::vector<MeshCut> cuts;
  add_cuts(data_->tree, csg::MeshLine(ray), ray, 0, kInf, cuts);
  std::int32_t winding = 0;
  for (const MeshCut& c : cuts) winding += c.count;
  return winding != 0;
}

Vec3 Mesh::outward_normal(const Ray& ray, double t) const {
  std::vector<MeshCut> cuts;
  add_cuts(data_->tree, csg::MeshLine(ray), ray, t, std::nextafter(t, kInf), cuts);
  std::int32_t sum = 0;
  for (const MeshCut& c : cuts) sum += c.count;
  // If several triangles are cut, takes one that is crossed the same way as the surface is; the
  // choice must not depend on their order.
  Vec3 best;
  bool found = false;
  for (const MeshCut& c : cuts) {
    if (sum != 0 && (c.count > 0) != (sum > 0)) continue;
    const TriangleBlock& block = data_->tree.blocks()[c.triangle / TriangleBlock::kWidth];
    const std::size_t place = c.triangle % TriangleBlock::kWidth;
    const Vec3 a = block.corner(place, 0);
    const Vec3 normal = normalized(cross(block.corner(place, 1) - a, block.corner(place, 2) - a));
    if (!found || is_before(normal, best)) best = normal;
    found = true;
  }
  return best;
}

CellSide Mesh::classify(const Aabb& cell) const {
  const Aabb near = intersection_of(cell, data_->bounds);
  if (near.is_empty()) return CellSide::kOutside;
  if (data_->tree.may_touch(cell)) return CellSide::kCrosses;
  return contains(near.center()) ? CellSide::kInside : CellSide::kOutside;
}

}  // namespace graycube
