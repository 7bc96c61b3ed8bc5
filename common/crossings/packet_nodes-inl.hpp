// Takes a packet of rays through a hierarchy of boxes: the surface tree's, or a mesh's.
#if defined(GRAYCUBE_SPACE_PACKET_NODES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_PACKET_NODES_INL
#undef GRAYCUBE_SPACE_PACKET_NODES_INL
#else
#define GRAYCUBE_SPACE_PACKET_NODES_INL
#endif

#include <hwy/highway.h>

#include <vector>

#include "crossings/packet_culling-inl.hpp"
#include "crossings/tree_walk-inl.hpp"
#include "set_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// This many rays or fewer are walked singly: a node costs a packet about three single visits.
constexpr int kFewRays = 3;

/// Takes a packet through the nodes, of which the first is the root. Calls leaf(index, rays) for
/// each leaf that some of the packet's rays may meet, with those rays; and walk(node, ray) for each
/// of the last few rays that have a subtree left to visit. Rays that `active` drops in the meantime
/// are left out.
template <Order order, typename Leaf, typename Walk>
void each_leaf_of_packet(const std::vector<WideNode>& nodes, const CullingPacket& p,
                         const Mask& active, TreeScratch& scratch, Leaf&& leaf, Walk&& walk) {
  if (nodes.empty() || active == 0) return;
  struct StackEntry {
    const WideNode* node;
    float t;
    std::uint32_t slot;
    Mask rays;
  };
  StackEntry stack[SurfaceTree::kMaxStack];
  std::size_t size = 0;
  const auto visit = [&](const WideNode& node, Mask rays) {
    ++scratch.counts.cells_visited;
    HWY_ALIGN float near[WideNode::kWidth];
    const std::uint32_t mask = meet_all(node, p, near);
    const std::size_t base = size;
    for (const std::size_t i : SetBits(mask)) {
      std::size_t at = size++;
      if constexpr (order == Order::kNearestFirst) at = make_place(stack, base, at, near[i]);
      stack[at] = {&node, near[i], static_cast<std::uint32_t>(i), rays};
    }
  };
  visit(nodes.front(), active);
  while (size > 0) {
    const StackEntry top = stack[--size];
    if (top.t > p.last_of_all) continue;
    const Mask rays = meet_each(*top.node, top.slot, p, top.rays & active);
    if (rays == 0) continue;
    const std::uint32_t child = top.node->child[top.slot];
    if ((child & WideNode::kItemFlag) != 0) {
      leaf(child & ~WideNode::kItemFlag, rays);
      if (active == 0) return;
    } else if (__builtin_popcount(rays) <= kFewRays) {
      for (const std::size_t i : SetBits(rays)) walk(child, i);
      if (active == 0) return;
    } else {
      visit(nodes[child], rays);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
