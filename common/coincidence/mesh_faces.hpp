// The triangles of a mesh as plane faces, which may lie in planes of other solids.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "coincidence/exactness.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// A triangle that is wide enough to know its plane by.
struct MeshFace {
  Plane plane;
  Vec3 middle;
  double direction_tolerance = 0;
};

/// The triangles of one mesh that may touch other primitives, and the planes that they get. The
/// mesh's corners and what is counted by them stay as they are: closed stays closed, only the
/// parameter at which a line meets a triangle is that of the plane.
class MeshFaces {
 public:
  MeshFaces(const Model& model, std::uint32_t primitive, const Exactness& exactness);

  std::uint32_t primitive() const { return primitive_; }

  /// Calls visit(triangle, MeshFace) for those near another primitive.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::uint32_t i = 0; i < surface().triangles.size(); ++i) {
      if (!is_near(i)) continue;
      const MeshFace f = face(i);
      if (f.direction_tolerance <= kWorstDirection) visit(i, f);
    }
  }
  MeshFace face(std::uint32_t triangle) const;

  /// The plane is left alone where it isn't the triangle's to within how exactly its corners are
  /// known.
  void set(std::uint32_t triangle, const Plane& plane);
  /// Puts the mesh with the planes set into the model, and grows its bounds; false when there are
  /// none. Slender triangles, by which no plane is known, get that of neighbours with which they
  /// share their corners.
  bool settle(Model& model);

 private:
  /// Radians; triangles that know their normals worse are too slender.
  static constexpr double kWorstDirection = 1e-3;

  const TriangleMesh& surface() const { return mesh_.surface(); }
  bool is_near(std::uint32_t triangle) const;
  bool lies_in(std::uint32_t triangle, const Plane& plane) const;
  void spread_to_slender();

  Mesh mesh_;
  std::uint32_t primitive_;
  Exactness exactness_;
  /// Around what other primitives may touch.
  Aabb near_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> plane_of_;
};

}  // namespace graycube::csg
