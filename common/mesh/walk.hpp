// A line's way through the triangles of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/line.hpp"
#include "mesh/tree.hpp"

namespace graycube {

/// Where a line passes through a triangle: `count` is what it adds to the winding number, +1 on the
/// way in.
struct MeshCut {
  double t;
  std::int32_t count;
  /// The block, times its width, and the place in it.
  std::uint32_t triangle;
};

/// Appends the line's cuts with least ≤ t < below, in any order. 0 ≤ least or below ≤ 0.
void add_cuts(const MeshTree& tree, const csg::MeshLine& line, const Ray& ray, double least,
              double below, std::vector<MeshCut>& cuts);

}  // namespace graycube
