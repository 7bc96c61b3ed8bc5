// Finds a line's cuts with the triangles of a block. Included once for each instruction set, in the
// way of Highway's own headers; which one runs can't show in a result.
#if defined(GRAYCUBE_CSG_MESH_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_CSG_MESH_WALK_INL
#undef GRAYCUBE_CSG_MESH_WALK_INL
#else
#define GRAYCUBE_CSG_MESH_WALK_INL
#endif

#include <hwy/highway.h>

#include <vector>

#include "geometry/interval.hpp"
#include "geometry/wide_node-inl.hpp"
#include "mesh/walk.hpp"
#include "set_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles4 = hn::CappedTag<double, TriangleBlock::kWidth>;

/// The coordinates of a block's corners across the line.
struct SeenBlock {
  HWY_ALIGN double x[3][TriangleBlock::kWidth];
  HWY_ALIGN double y[3][TriangleBlock::kWidth];

  csg::LinePoint corner(std::size_t place, std::size_t which) const {
    return {x[which][place], y[which][place]};
  }
};

/// Computes the corners' coordinates by the expressions of MeshLine::see. Bit i of the result tells
/// that triangle i is neither above nor below nor to the left of the line, and so may be cut; the
/// counts of all others are 0.
HWY_INLINE std::uint32_t see(const TriangleBlock& block, const csg::MeshLine& line,
                             SeenBlock& seen) {
  const Doubles4 d;
  const auto zero = hn::Zero(d);
  const Vec3 &o = line.origin(), &across = line.x_axis(), &upright = line.y_axis();
  std::uint32_t candidates = 0;
  for (std::size_t i = 0; i < TriangleBlock::kWidth; i += hn::Lanes(d)) {
    std::uint32_t all_above = ~0u, any_above = 0, any_right = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& corner = block.corners[c];
      const auto qx = hn::Sub(hn::Load(d, corner[0].data() + i), hn::Set(d, o.x));
      const auto qy = hn::Sub(hn::Load(d, corner[1].data() + i), hn::Set(d, o.y));
      const auto qz = hn::Sub(hn::Load(d, corner[2].data() + i), hn::Set(d, o.z));
      const auto along = [&](const Vec3& axis) {
        return hn::Add(hn::Add(hn::Mul(hn::Set(d, axis.x), qx), hn::Mul(hn::Set(d, axis.y), qy)),
                       hn::Mul(hn::Set(d, axis.z), qz));
      };
      const auto x = along(across), y = along(upright);
      hn::Store(x, d, seen.x[c] + i);
      hn::Store(y, d, seen.y[c] + i);
      std::uint8_t above[8] = {}, right[8] = {};
      hn::StoreMaskBits(d, hn::Ge(y, zero), above);
      hn::StoreMaskBits(d, hn::Ge(x, zero), right);
      all_above &= above[0];
      any_above |= above[0];
      any_right |= right[0];
    }
    candidates |= (any_above & ~all_above & any_right) << i;
  }
  return candidates;
}

/// Appends the line's cuts with the block's triangles at least ≤ t < below.
HWY_INLINE void add_block_cuts(const MeshTree& tree, std::uint32_t index, const csg::MeshLine& line,
                               const Ray& ray, double least, double below,
                               std::vector<MeshCut>& cuts) {
  SeenBlock seen;
  const TriangleBlock& block = tree.blocks()[index];
  for (const std::size_t i : SetBits(see(block, line, seen))) {
    const int count =
        line.turn() * csg::winding_of(seen.corner(i, 0), seen.corner(i, 1), seen.corner(i, 2));
    if (count == 0) continue;
    const auto triangle = static_cast<std::uint32_t>(index * TriangleBlock::kWidth + i);
    const Plane* plane = tree.plane_of(triangle);
    const double slope = plane != nullptr ? dot(plane->normal, ray.direction) : 0.0;
    const double t =
        std::fabs(slope) > csg::kLeastSine * max_abs(ray.direction)
            ? csg::plane_parameter(plane->offset, dot(plane->normal, ray.origin), 1.0 / slope) + 0.0
            : csg::triangle_parameter(line, ray, block.corner(i, 0), block.corner(i, 1),
                                      block.corner(i, 2));
    if (t >= least && t < below) {
      cuts.push_back({t, count, triangle});
    }
  }
}

/// Like add_block_cuts(), for all blocks below a node that the line may meet in [from, to].
HWY_INLINE void add_cuts_below(const MeshTree& tree, std::uint32_t root, const CullingRay& culling,
                               float from, float to, const csg::MeshLine& line, const Ray& ray,
                               double least, double below, std::vector<MeshCut>& cuts) {
  std::uint32_t stack[MeshTree::kMaxStack];
  std::size_t size = 0;
  stack[size++] = root;
  while (size > 0) {
    const WideNode& node = tree.nodes()[stack[--size]];
    HWY_ALIGN float near[WideNode::kWidth];
    for (const std::size_t i : SetBits(meet(node, culling, from, to, near))) {
      const std::uint32_t child = node.child[i];
      if ((child & WideNode::kItemFlag) == 0) {
        stack[size++] = child;
      } else {
        add_block_cuts(tree, child & ~WideNode::kItemFlag, line, ray, least, below, cuts);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
