// The flat parts of a mesh: neighbouring triangles that lie in one plane as exactly as their
// corners are known. Most triangles of a face are too slender to know its plane by; together they
// know it as well as the face is wide.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube::csg {

struct Flat {
  Plane plane;
  /// A point of the plane, among the triangles.
  Vec3 middle;
  /// The least height of the widest triangle between corners: the plane's normal is off by a
  /// corner's error over it, in radians. 0 or not a number for triangles without an area.
  double width = 0;
  /// Of MeshFlats' triangles.
  std::uint32_t first = 0, count = 0;
};

class MeshFlats {
 public:
  /// Of some of the mesh's triangles, whose corners may be off by `distance`. Each is of one flat
  /// part. O(n log n).
  MeshFlats(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles, double distance);

  std::span<const Flat> flats() const { return flats_; }
  std::span<const std::uint32_t> triangles_of(const Flat& f) const {
    return std::span(triangles_).subspan(f.first, f.count);
  }

 private:
  std::vector<Flat> flats_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace graycube::csg
