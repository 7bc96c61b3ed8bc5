// Tests a ray against the boxes of a node. Included once for each instruction set, in the way of
// Highway's own headers; which one runs can't show in a result, since boxes only cull.
#if defined(GRAYCUBE_GEOMETRY_WIDE_NODE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_GEOMETRY_WIDE_NODE_INL
#undef GRAYCUBE_GEOMETRY_WIDE_NODE_INL
#else
#define GRAYCUBE_GEOMETRY_WIDE_NODE_INL
#endif

#include <hwy/highway.h>

#include "geometry/culling_ray.hpp"
#include "geometry/wide_node.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Tests the eight boxes of a node against [t0, t1]; bit i of the result tells whether the ray may
/// meet child i, from near[i] on.
HWY_INLINE std::uint32_t meet(const WideNode& node, const CullingRay& ray, float t0, float t1,
                              float* HWY_RESTRICT near) {
  const hn::CappedTag<float, WideNode::kWidth> d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < WideNode::kWidth; i += lanes) {
    auto from = hn::Set(d, t0);
    auto to = hn::Set(d, t1);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto near_plane = hn::Load(d, node.planes[ray.near_side[a]][a].data() + i);
      const auto far_plane = hn::Load(d, node.planes[1 - ray.near_side[a]][a].data() + i);
      const auto enter = hn::Mul(hn::Sub(near_plane, hn::Set(d, ray.near_origin[a])),
                                 hn::Set(d, ray.near_inverse[a]));
      const auto leave = hn::Mul(hn::Sub(far_plane, hn::Set(d, ray.far_origin[a])),
                                 hn::Set(d, ray.far_inverse[a]));
      from = hn::Max(from, enter);
      to = hn::Min(to, leave);
    }
    hn::StoreU(from, d, near + i);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Le(from, to), bits);
    mask |= static_cast<std::uint32_t>(bits[0] & ((1u << lanes) - 1)) << i;
  }
  return mask;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
