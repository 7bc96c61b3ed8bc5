// How one ray passes through the nodes of the surface tree. Included once for each instruction set,
// in the way of Highway's own headers; which one runs can't show in a result, since boxes only
// cull, conservatively, and crossings are computed in doubles.
#if defined(GRAYCUBE_SPACE_TREE_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_TREE_WALK_INL
#undef GRAYCUBE_SPACE_TREE_WALK_INL
#else
#define GRAYCUBE_SPACE_TREE_WALK_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "crossings/surface_tree.hpp"
#include "geometry/culling_ray.hpp"
#include "geometry/wide_node-inl.hpp"
#include "set_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE float float_up(double t) {
  const auto f = static_cast<float>(t);
  return f * (1 + kSlack) + 1e-37f;
}
HWY_INLINE float float_down(double t) { return static_cast<float>(t) * (1 - kSlack); }

HWY_INLINE std::size_t octant(const Vec3& d) {
  return (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
}

/// The order in which boxes are visited. A search for the first crossing takes near boxes first;
/// for a search for any crossing, sorting costs more than it saves.
enum class Order { kNearestFirst, kAny };

/// Moves the entries of a stack from `base` on that are nearer than t up by one place; returns the
/// place that becomes free.
template <typename Entry>
HWY_INLINE std::size_t make_place(Entry* stack, std::size_t base, std::size_t top, float t) {
  while (top > base && stack[top - 1].t < t) {
    stack[top] = stack[top - 1];
    --top;
  }
  return top;
}

/// Calls visit(item index) for the items below `root` whose boxes the ray may meet in [t0, t1()],
/// until it returns false.
template <Order order, typename End, typename Visit>
bool each_item_below(const std::vector<WideNode>& nodes, std::uint32_t root, const CullingRay& ray,
                     float t0, End&& t1, TreeScratch& scratch, Visit&& visit) {
  struct StackEntry {
    std::uint32_t child;
    float t;
  };
  StackEntry stack[SurfaceTree::kMaxStack];
  std::size_t size = 0;
  stack[size++] = {root, t0};
  while (size > 0) {
    const StackEntry top = stack[--size];
    const float last = float_up(t1());
    if (top.t > last) continue;
    if ((top.child & WideNode::kItemFlag) != 0) {
      if (!visit(top.child & ~WideNode::kItemFlag)) return false;
      continue;
    }
    ++scratch.counts.cells_visited;
    const WideNode& node = nodes[top.child];
    HWY_ALIGN float near[WideNode::kWidth];
    const std::uint32_t mask = meet(node, ray, t0, last, near);
    const std::size_t base = size;
    for (const std::size_t i : SetBits(mask)) {
      std::size_t at = size++;
      if constexpr (order == Order::kNearestFirst) at = make_place(stack, base, at, near[i]);
      stack[at] = {node.child[i], near[i]};
    }
  }
  return true;
}

/// Replaces `found` by the item's first crossing with t0 ≤ t < found.t; at equal t the first object
/// wins. Before anything is found, found.t is the ray's end.
HWY_INLINE void take_first_crossing(const SurfaceTree& tree, std::uint32_t index,
                                    const PreparedRay& ray, double t0, TreeScratch& scratch,
                                    Crossing& found, bool& any) {
  const SurfaceItem& item = tree.items()[index];
  const bool wins_ties = any && item.object < found.object;
  const double end = wins_ties ? std::nextafter(found.t, kInf) : found.t;
  tree.for_each_item_crossing(item, ray, t0, end, scratch, [&](const Crossing& c) {
    found = c;
    any = true;
    return false;
  });
}

/// Dims the light of each ray by the panes that it crosses; `light` is indexed by ray.
inline void dim(std::vector<TreeScratch::Pane>& panes, Rgb* light) {
  if (panes.empty()) return;
  using Pane = TreeScratch::Pane;
  std::sort(panes.begin(), panes.end(), [](const Pane& a, const Pane& b) {
    return a.t != b.t ? a.t < b.t : a.object < b.object;
  });
  for (const Pane& pane : panes) light[pane.ray] = pane.transmit * light[pane.ray];
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
