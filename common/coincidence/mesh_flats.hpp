// The flat parts of a mesh: neighbouring triangles that lie in one plane as exactly as their
// corners are known. Most triangles of a face are too slender to tell its plane; all together they
// tell it as exactly as the width of the face allows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace graycube::csg {

struct Flat {
  Plane plane;
  /// A point of the plane, in the middle of the widest triangle.
  Vec3 middle;
  /// The least height of the widest triangle between corners: the plane's normal is off by a
  /// corner's error divided by this, in radians. 0 or NaN for triangles without an area.
  double width = 0;
  /// A range of MeshFlats' triangles.
  std::uint32_t first = 0, count = 0;
};

class MeshFlats {
 public:
  /// Takes some of the mesh's triangles, whose corners may be off by `distance`. Each of them
  /// becomes part of one flat part. O(n log n).
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
