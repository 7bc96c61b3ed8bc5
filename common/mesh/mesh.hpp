// A closed triangle mesh as a solid: a point is inside where the surface winds around it, so shells
// that overlap are a union and inner shells that face inwards are cavities. Lines find its
// triangles through a hierarchy of float boxes, which only cull.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/ray.hpp"
#include "geometry/spans.hpp"
#include "mesh/triangle_mesh.hpp"
#include "mesh/walk.hpp"

namespace graycube {

/// A mesh as a value; copies share its data, which never change.
class Mesh {
 public:
  /// The empty mesh.
  Mesh();
  /// The triangles must be closed (mesh/close_mesh.hpp) and their indices in range. An open mesh
  /// gives nonsense, but never more than that.
  explicit Mesh(TriangleMesh surface);

  const TriangleMesh& surface() const;
  const Aabb& bounds() const;
  const MeshTree& tree() const;
  std::size_t memory_bytes() const;

  /// These do for a mesh what the functions of csg/primitive.hpp do for any primitive.
  Spans spans(const Ray& ray) const;
  bool contains(const Vec3& point) const;
  Vec3 outward_normal(const Ray& ray, double t) const;
  CellSide classify(const Aabb& cell) const;

  /// Replaces `cuts` by the line's cuts at t ≥ from ≥ 0, in order of t. Since all counts of a line
  /// add up to zero, the winding number at `from` is minus their sum.
  void cuts_ahead(const Ray& ray, double from, std::vector<MeshCut>& cuts) const;
  /// Replaces `cuts` by the line's cuts at from ≤ t < below, in order of t.
  void cuts_between(const Ray& ray, double from, double below, std::vector<MeshCut>& cuts) const;

  /// Like spans(), but from t = 0 on: a span that the ray starts in is given the enter −infinity.
  /// `cuts` is scratch space.
  Spans spans_ahead(const Ray& ray, std::vector<MeshCut>& cuts) const;

  /// Whether the line surely reaches the mesh's bounds only after t: then all its cuts are ahead of
  /// t, and the winding number at t, like their sum, is 0.
  bool is_before_bounds(const Ray& ray, double t) const;

  /// Calls visit(t, entering) where the cuts, given in order, cross the surface before t1, until
  /// visit returns false; then returns false. `winding` is the winding number before the first cut.
  template <typename Visit>
  static bool visit_crossings(const std::vector<MeshCut>& cuts, std::int32_t winding, double t1,
                              Visit&& visit) {
    for (std::size_t i = 0; i < cuts.size();) {
      const double t = cuts[i].t;
      const bool was_inside = winding != 0;
      for (; i < cuts.size() && cuts[i].t == t; ++i) winding += cuts[i].count;
      if (t >= t1) return true;
      if ((winding != 0) != was_inside && !visit(t, winding != 0)) return false;
    }
    return true;
  }
  /// The winding number before `cuts`, if they are all cuts of the line from there on.
  static std::int32_t winding_before(const std::vector<MeshCut>& cuts) {
    std::int32_t winding = 0;
    for (const MeshCut& c : cuts) winding -= c.count;
    return winding;
  }
  static void sort_by_parameter(std::vector<MeshCut>& cuts);

  /// Calls visit(t, entering) where the line crosses the surface in [t0, t1), 0 ≤ t0, in order,
  /// until visit returns false; then returns false. `cuts` is scratch space.
  template <typename Visit>
  bool crossings(const Ray& ray, double t0, double t1, std::vector<MeshCut>& cuts,
                 Visit&& visit) const {
    if (is_before_bounds(ray, t0)) {
      cuts_between(ray, t0, t1, cuts);
      return visit_crossings(cuts, 0, t1, visit);
    }
    cuts_ahead(ray, t0, cuts);
    return visit_crossings(cuts, winding_before(cuts), t1, visit);
  }

  /// Whether the two meshes are copies of one.
  bool is_same_as(const Mesh& other) const { return data_ == other.data_; }
  friend bool operator==(const Mesh& a, const Mesh& b) {
    return a.data_ == b.data_ || a.surface() == b.surface();
  }

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace graycube
