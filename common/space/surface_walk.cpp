// Rays through the surface tree. Compiled once for each instruction set (Highway); which one runs can't show
// in a result, since boxes only cull, conservatively, and crossings are computed in doubles.
#include "space/surface_tree.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "space/surface_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Relative error of a float plane parameter: a reciprocal, a difference and a product, each rounded once
/// and the direction before, with room to spare.
constexpr float kSlack = 1e-6f;
/// Directions flatter than this count as this: such a ray doesn't move sideways within any scene.
constexpr float kFlattest = 1e-30f;
constexpr std::size_t kMaxStack = 512;

/// A ray in floats, made so that no box which the exact ray meets is missed: distances are taken from a
/// little before the origin to the near planes, from a little behind it to the far ones, and the
/// reciprocals carry the slack.
struct CullingRay {
  explicit CullingRay(const Ray& ray) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto f = static_cast<float>(ray.origin[static_cast<int>(a)]);
      const float error = std::fabs(f) * 1.2e-7f + 1e-37f;
      auto d = static_cast<float>(ray.direction[static_cast<int>(a)]);
      if (std::fabs(d) < kFlattest) d = std::signbit(d) ? -kFlattest : kFlattest;
      near_side[a] = d < 0 ? 1 : 0;
      near_inverse[a] = (1 - kSlack) / d;
      far_inverse[a] = (1 + kSlack) / d;
      near_origin[a] = d < 0 ? f - error : f + error;
      far_origin[a] = d < 0 ? f + error : f - error;
    }
  }
  std::array<float, 3> near_inverse, far_inverse, near_origin, far_origin;
  /// Index into WideNode::planes of the side that the ray meets first.
  std::array<std::size_t, 3> near_side;
};

struct StackEntry {
  std::uint32_t child;
  float t;
};

/// Tests the eight boxes of a node against [t0, t1]; bit i of the result: child i may be met, from near[i] on.
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

float float_up(double t) {
  const auto f = static_cast<float>(t);
  return f * (1 + kSlack) + 1e-37f;
}
float float_down(double t) { return static_cast<float>(t) * (1 - kSlack); }

/// Calls visit(item index) for the items whose boxes the ray may meet in [t0, t1()], nearest boxes first,
/// until it returns false.
template <typename End, typename Visit>
bool each_item(const SurfaceTree& tree, const Ray& ray, double t0, End&& t1, TreeScratch& scratch,
               Visit&& visit) {
  for (const std::uint32_t item : tree.unbounded_items()) {
    if (!visit(item)) return false;
  }
  if (tree.nodes().empty()) return true;
  const CullingRay culling(ray);
  const float first = float_down(t0);
  StackEntry stack[kMaxStack];
  std::size_t size = 0;
  stack[size++] = {0, first};
  while (size > 0) {
    const StackEntry top = stack[--size];
    const float last = float_up(t1());
    if (top.t > last) continue;
    if ((top.child & WideNode::kItemFlag) != 0) {
      if (!visit(top.child & ~WideNode::kItemFlag)) return false;
      continue;
    }
    ++scratch.counts.cells_visited;
    const WideNode& node = tree.nodes()[top.child];
    HWY_ALIGN float near[WideNode::kWidth];
    std::uint32_t mask = meet(node, culling, first, last, near);
    const std::size_t base = size;
    while (mask != 0) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      mask &= mask - 1;
      // Farthest first, so that the nearest is on top.
      std::size_t at = size++;
      while (at > base && stack[at - 1].t < near[i]) {
        stack[at] = stack[at - 1];
        --at;
      }
      stack[at] = {node.child[i], near[i]};
    }
  }
  return true;
}

bool FirstCrossing(const SurfaceTree& tree, const Ray& ray, double t0, double t1,
                   TreeScratch& scratch, Crossing& found) {
  const PreparedRay prepared(ray);
  bool any = false;
  found.t = t1;
  each_item(tree, ray, t0, [&] { return found.t; }, scratch, [&](std::uint32_t index) {
    const SurfaceItem& item = tree.items()[index];
    // At equal t the first object wins.
    const bool wins_ties = any && item.object < found.object;
    const double end = wins_ties ? std::nextafter(found.t, Aabb::kInf) : found.t;
    tree.for_each_item_crossing(item, prepared, t0, end, scratch, [&](const Crossing& c) {
      found = c;
      any = true;
      return false;
    });
    return true;
  });
  return any;
}

std::size_t octant(const Vec3& d) {
  return (d.x < 0 ? 1u : 0u) | (d.y < 0 ? 2u : 0u) | (d.z < 0 ? 4u : 0u);
}

bool PassLight(const SurfaceTree& tree, const Ray& ray, double t0, double t1, TreeScratch& scratch,
               Rgb& light) {
  struct Pane {
    double t;
    std::uint32_t object;
    double transmit;
  };
  std::vector<Pane> panes;  // stays empty, and unallocated, where nothing is transparent
  const PreparedRay prepared(ray);
  const auto crosses_opaque = [&](std::uint32_t index) {
    return !tree.for_each_item_crossing(
        tree.items()[index], prepared, t0, t1, scratch, [&](const Crossing& c) {
          const double transmit = tree.transmit_of(c.primitive);
          if (transmit > 0) panes.push_back({c.t, c.object, transmit});
          return transmit > 0;
        });
  };
  // Neighbouring rays towards one light mostly end on the same object.
  std::uint32_t& last = scratch.last_occluder[octant(ray.direction)];
  if (last < tree.items().size() && crosses_opaque(last)) return false;
  panes.clear();
  const bool arrives =
      each_item(tree, ray, t0, [&] { return t1; }, scratch,
                [&](std::uint32_t index) {
                  if (!crosses_opaque(index)) return true;
                  last = index;
                  return false;
                });
  if (!arrives) return false;
  std::sort(panes.begin(), panes.end(), [](const Pane& a, const Pane& b) {
    return a.t != b.t ? a.t < b.t : a.object < b.object;
  });
  for (const Pane& pane : panes) light = pane.transmit * light;
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

HWY_EXPORT(FirstCrossing);
HWY_EXPORT(PassLight);

std::optional<Crossing> SurfaceTree::first_crossing(const Ray& ray, double t0, double t1,
                                                    TreeScratch& scratch) const {
  Crossing found;
  if (!HWY_DYNAMIC_DISPATCH(FirstCrossing)(*this, ray, t0, t1, scratch, found)) return std::nullopt;
  return found;
}

bool SurfaceTree::pass_light(const Ray& ray, double t0, double t1, TreeScratch& scratch,
                             Rgb& light) const {
  return HWY_DYNAMIC_DISPATCH(PassLight)(*this, ray, t0, t1, scratch, light);
}

}  // namespace graycube
#endif
