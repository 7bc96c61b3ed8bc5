// The flat parts of a mesh as plane faces, which may lie in planes of other solids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coincidence/exactness.hpp"
#include "coincidence/mesh_flats.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

struct MeshFace {
  Plane plane;
  /// A point in the middle of the face.
  Vec3 middle;
  double direction_tolerance = 0;
};

/// The flat parts of one mesh that may touch other primitives, and the planes that they get. The
/// mesh's corners, and the counts of lines that pass between them, stay as they are: a closed mesh
/// stays closed; only the parameter at which a line meets a triangle becomes that of the plane.
class MeshFaces {
 public:
  MeshFaces(const Model& model, std::uint32_t primitive, const Exactness& exactness);

  std::uint32_t primitive() const { return primitive_; }

  std::size_t count() const { return flats_.flats().size(); }
  /// Calls visit(number of the face, MeshFace) for each face wide enough for its plane to be known.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (std::uint32_t i = 0; i < count(); ++i) {
      const MeshFace f = face(i);
      if (f.direction_tolerance <= kWorstDirection) visit(i, f);
    }
  }
  MeshFace face(std::uint32_t number) const;

  /// Gives a face's triangles the plane, except those that surely aren't in it.
  void set(std::uint32_t number, const Plane& plane);
  /// Puts the mesh with the planes set into the model, and grows its bounds; false when there are
  /// none.
  bool settle(Model& model);

 private:
  /// Faces whose normals are known worse than this (radians) are too slender.
  static constexpr double kWorstDirection = 1e-3;

  const TriangleMesh& surface() const { return mesh_.surface(); }
  bool lies_in(std::uint32_t triangle, const Plane& plane) const;

  Mesh mesh_;
  std::uint32_t primitive_;
  Exactness exactness_;
  MeshFlats flats_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> plane_of_;
};

}  // namespace graycube::csg
