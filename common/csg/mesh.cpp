#include "csg/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "csg/mesh_line.hpp"
#include "csg/mesh_tree.hpp"
#include "csg/roots.hpp"

namespace graycube {

namespace csg {

double triangle_parameter(const MeshLine& line, const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  // Planes met at less than this sine count as seen edge on; rounding may exceed the corners' parameters by the other.
  constexpr double kLeastSine = 1e-6, kSlackOfParameter = 1e-12;
  const double ta = line.parameter(a), tb = line.parameter(b), tc = line.parameter(c);
  const double least = std::min(ta, std::min(tb, tc)), most = std::max(ta, std::max(tb, tc));
  const Vec3 normal = normalized(cross(b - a, c - a));
  const double slope = dot(normal, ray.direction);
  double t = 0;
  if (std::fabs(slope) > kLeastSine * max_abs(ray.direction)) {
    t = plane_parameter(dot(normal, a), dot(normal, ray.origin), 1.0 / slope);
    const double slack = kSlackOfParameter * (std::fabs(least) + std::fabs(most));
    if (t >= least - slack && t <= most + slack) return t + 0.0;
  } else {
    const LinePoint p = line.see(a), q = line.see(b), r = line.see(c);
    const double u = q.x * r.y - q.y * r.x, v = r.x * p.y - r.y * p.x, w = p.x * q.y - p.y * q.x;
    t = (u * ta + v * tb + w * tc) / (u + v + w);
  }
  // NaN, of triangles without an area, becomes the first corner reached.
  return (t >= least ? (t <= most ? t : most) : least) + 0.0;
}

}  // namespace csg

struct Mesh::Data {
  explicit Data(TriangleMesh mesh) : surface(std::move(mesh)), tree(surface) {
    for (const Vec3& p : surface.points) bounds.include(p);
  }

  /// Appends the cuts ahead of (or behind) the line's start that `keep` wants.
  template <typename Keep>
  void add_cuts(const csg::MeshLine& line, const Ray& ray, const CullingRay& culling, float from,
                std::vector<MeshCut>& cuts, Keep&& keep) const {
    const std::vector<Vec3>& points = surface.points;
    tree.along(culling, from, std::numeric_limits<float>::infinity(), [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t i = first; i < end; ++i) {
        const Triangle& t = tree.triangles()[i];
        const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
        const int count = csg::triangle_count(line, a, b, c);
        if (count == 0) continue;
        const double at = csg::triangle_parameter(line, ray, a, b, c);
        if (keep(at)) cuts.push_back({at, count, i});
      }
    });
  }
  /// Those at t ≥ from.
  void add_ahead(const csg::MeshLine& line, const Ray& ray, double from, std::vector<MeshCut>& cuts) const {
    add_cuts(line, ray, CullingRay(ray), static_cast<float>(from) * (1 - kSlack), cuts,
             [from](double t) { return t >= from; });
  }
  /// Those at t < 0.
  void add_behind(const csg::MeshLine& line, const Ray& ray, std::vector<MeshCut>& cuts) const {
    add_cuts(line, ray, CullingRay({ray.origin, -ray.direction}), 0, cuts, [](double t) { return t < 0; });
  }

  /// Conservative: may the surface touch the cell?
  bool may_touch(const Aabb& cell) const {
    return !tree.within(cell, [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t i = first; i < end; ++i) {
        if (triangle_may_touch(tree.triangles()[i], cell)) return false;
      }
      return true;
    });
  }
  /// By the boxes, and by the triangle's plane.
  bool triangle_may_touch(const Triangle& t, const Aabb& cell) const {
    const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    Aabb box{a, a};
    box.include(b);
    box.include(c);
    if (!box.overlaps(cell)) return false;
    const Aabb near = intersection_of(box, cell);
    const Vec3 n = cross(b - a, c - a), middle = near.center() - a, half = 0.5 * (near.hi - near.lo);
    const Vec3 size{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
    const double rounding = 1e-12 * (dot(size, Vec3{std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)}) +
                                     dot(size, half));
    return !(std::fabs(dot(n, middle)) > dot(size, half) + rounding);
  }

  TriangleMesh surface;
  MeshTree tree;
  Aabb bounds = Aabb::nothing();
};

namespace {

void sort_by_parameter(std::vector<MeshCut>& cuts) {
  std::sort(cuts.begin(), cuts.end(), [](const MeshCut& a, const MeshCut& b) { return a.t < b.t; });
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

std::size_t Mesh::memory_bytes() const {
  return sizeof(Data) + data_->surface.points.size() * sizeof(Vec3) +
         data_->surface.triangles.size() * sizeof(Triangle) + data_->tree.memory_bytes();
}

void Mesh::cuts_ahead(const Ray& ray, double from, std::vector<MeshCut>& cuts) const {
  cuts.clear();
  data_->add_ahead(csg::MeshLine(ray), ray, from, cuts);
  sort_by_parameter(cuts);
}

Spans Mesh::spans(const Ray& ray) const {
  std::vector<MeshCut> cuts;
  const csg::MeshLine line(ray);
  data_->add_behind(line, ray, cuts);
  data_->add_ahead(line, ray, 0, cuts);
  sort_by_parameter(cuts);
  Spans spans;
  std::int32_t winding = 0;
  double entered = -csg::kInf;
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
  if (winding != 0) spans.add(entered, csg::kInf);  // only of an open mesh
  return spans;
}

bool Mesh::contains(const Vec3& point) const {
  // Along no plane that a model is likely to have.
  const Ray ray{point, {0.36154797, 0.48223431, 0.79794753}};
  std::vector<MeshCut> cuts;
  data_->add_ahead(csg::MeshLine(ray), ray, 0, cuts);
  std::int32_t winding = 0;
  for (const MeshCut& c : cuts) winding += c.count;
  return winding != 0;
}

Vec3 Mesh::outward_normal(const Ray& ray, double t) const {
  std::vector<MeshCut> cuts;
  const csg::MeshLine line(ray);
  const auto keep = [t](double at) { return at == t; };
  const bool is_ahead = t >= 0;
  const CullingRay culling(is_ahead ? ray : Ray{ray.origin, -ray.direction});
  data_->add_cuts(line, ray, culling, static_cast<float>(std::fabs(t)) * (1 - kSlack), cuts, keep);
  std::int32_t sum = 0;
  for (const MeshCut& c : cuts) sum += c.count;
  // Of several triangles one that is crossed as the surface is; which one may not depend on their order.
  Vec3 best;
  bool found = false;
  for (const MeshCut& c : cuts) {
    if (sum != 0 && (c.count > 0) != (sum > 0)) continue;
    const Triangle& corners = data_->tree.triangles()[c.triangle];
    const std::vector<Vec3>& points = data_->surface.points;
    const Vec3& a = points[corners[0]];
    const Vec3 normal = normalized(cross(points[corners[1]] - a, points[corners[2]] - a));
    if (!found || is_before(normal, best)) best = normal;
    found = true;
  }
  return best;
}

CellSide Mesh::classify(const Aabb& cell) const {
  const Aabb near = intersection_of(cell, data_->bounds);
  if (near.is_empty()) return CellSide::kOutside;
  if (data_->may_touch(cell)) return CellSide::kCrosses;
  return contains(near.center()) ? CellSide::kInside : CellSide::kOutside;
}

}  // namespace graycube
