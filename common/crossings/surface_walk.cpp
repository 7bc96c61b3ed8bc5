// Takes single rays through the surface tree.
#include "crossings/surface_tree.hpp"
#include "geometry/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crossings/surface_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "crossings/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// Like each_item_below(), for the whole tree.
template <Order order, typename End, typename Visit>
bool each_item(const SurfaceTree& tree, const Ray& ray, double t0, End&& t1, TreeScratch& scratch,
               Visit&& visit) {
  for (const std::uint32_t item : tree.unbounded_items()) {
    if (!visit(item)) return false;
  }
  if (tree.nodes().empty()) return true;
  return each_item_below<order>(tree.nodes(), 0, CullingRay(ray), float_down(t0), t1, scratch,
                                visit);
}

bool FirstCrossing(const SurfaceTree& tree, const Ray& ray, double t0, double t1,
                   TreeScratch& scratch, Crossing& found) {
  const PreparedRay prepared(ray);
  bool any = false;
  found.t = t1;
  each_item<Order::kNearestFirst>(
      tree, ray, t0, [&] { return found.t; }, scratch,
      [&](std::uint32_t index) {
        take_first_crossing(tree, index, prepared, t0, scratch, found, any);
        return true;
      });
  return any;
}

bool PassLight(const SurfaceTree& tree, const Ray& ray, double t0, double t1, TreeScratch& scratch,
               Rgb& light) {
  auto& panes = scratch.panes;
  panes.clear();
  const PreparedRay prepared(ray);
  const auto crosses_opaque = [&](std::uint32_t index) {
    return !tree.for_each_item_crossing(tree.items()[index], prepared, t0, t1, scratch,
                                        [&](const Crossing& c) {
                                          const double transmit = tree.transmit_of(c.primitive);
                                          if (transmit > 0)
                                            panes.push_back({0, c.t, c.object, transmit});
                                          return transmit > 0;
                                        });
  };
  // Neighbouring rays towards one light mostly end on the same object.
  std::uint32_t& last = scratch.last_occluder[octant(ray.direction)];
  if (last < tree.items().size() && crosses_opaque(last)) return false;
  panes.clear();
  const bool arrives = each_item<Order::kAny>(
      tree, ray, t0, [&] { return t1; }, scratch,
      [&](std::uint32_t index) {
        if (!crosses_opaque(index)) return true;
        last = index;
        return false;
      });
  if (!arrives) return false;
  dim(panes, &light);
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(FirstCrossing);
GRAYCUBE_SIMD_TABLE(PassLight);

std::optional<Crossing> SurfaceTree::first_crossing(const Ray& ray, double t0, double t1,
                                                    TreeScratch& scratch) const {
  Crossing found;
  if (!GRAYCUBE_SIMD_CALL(FirstCrossing)(*this, ray, t0, t1, scratch, found)) return std::nullopt;
  return found;
}

bool SurfaceTree::pass_light(const Ray& ray, double t0, double t1, TreeScratch& scratch,
                             Rgb& light) const {
  return GRAYCUBE_SIMD_CALL(PassLight)(*this, ray, t0, t1, scratch, light);
}

}  // namespace graycube
#endif
