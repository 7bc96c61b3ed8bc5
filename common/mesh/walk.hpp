// Finds the triangles of a mesh that a line passes through.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/line.hpp"
#include "mesh/tree.hpp"

namespace graycube {

/// A point at which a line passes through a triangle; `count` is added to the winding number there:
/// +1 on the way in, −1 on the way out.
struct MeshCut {
  double t;
  std::int32_t count;
  /// The index of the block times TriangleBlock::kWidth, plus the place in the block.
  std::uint32_t triangle;
};

/// Appends the line's cuts with least ≤ t < below, in any order. 0 ≤ least or below ≤ 0.
void add_cuts(const MeshTree& tree, const csg::MeshLine& line, const Ray& ray, double least,
              double below, std::vector<MeshCut>& cuts);

}  // namespace graycube
