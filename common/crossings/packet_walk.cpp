// Takes packets of rays through the surface tree. A whole packet is tested against a node's eight
// boxes at once, by the bounds of its rays (float operations are monotonic, so that culls only what
// each ray's own test would cull); then each child is tested for each ray, when its turn comes.
// When few rays are left, they go on singly.
#include <algorithm>
#include <cmath>

#include "crossings/ray_packet.hpp"
#include "crossings/surface_tree.hpp"
#include "geometry/simd.hpp"
#include "set_bits.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "crossings/packet_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "crossings/lane_item-inl.hpp"
#include "crossings/mesh_packet-inl.hpp"
#include "crossings/packet_nodes-inl.hpp"
#include "crossings/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// Whether there are enough rays for going through a mesh together to pay.
bool has_many(Mask rays) { return __builtin_popcount(rays) > kFewRays; }

/// Takes a packet through the items without bounds, then through the tree like
/// each_leaf_of_packet().
template <Order order, typename Item, typename Walk>
void each_item_of_packet(const SurfaceTree& tree, const CullingPacket& p, const Mask& active,
                         TreeScratch& scratch, Item&& item, Walk&& walk) {
  for (const std::uint32_t i : tree.unbounded_items()) {
    if (active != 0) item(i, active);
  }
  each_leaf_of_packet<order>(tree.nodes(), p, active, scratch, item, walk);
}

/// Finds the first crossing of each of `rays` with an item that is one mesh. Where it is the first
/// of all crossings so far, stores it and calls shorten(ray).
template <typename Shorten>
void first_crossings_of_mesh(const SurfaceTree& tree, const SurfaceItem& item,
                             const RayPacket& packet, const CullingPacket& p, Mask rays, Mask any,
                             TreeScratch& scratch, const double* t1, Crossing* found,
                             Shorten&& shorten) {
  const Literal& literal = tree.literals_of(item).front();
  const bool swaps = literal.is_inverted != item.is_complement;
  HWY_ALIGN double end[kRays];
  for (std::size_t i = 0; i < kRays; ++i) {
    // At equal t the first object wins.
    const bool wins_ties = (any >> i & 1) != 0 && item.object < found[i].object;
    end[i] = wins_ties ? std::nextafter(t1[i], kInf) : t1[i];
  }
  MeshPacket mesh(tree.mesh_of(item), packet, p, rays, end, true, scratch);
  mesh.crossings<Order::kNearestFirst>([&](std::size_t i, double t, bool entering) {
    found[i] = {t, literal.primitive, item.object, entering != swaps};
    shorten(i);
    return false;
  });
}

/// Those of `rays` for which passes(ray, crossing) is false at some crossing with a mesh's item.
template <typename Passes>
Mask rays_ended_by_mesh(const SurfaceTree& tree, const SurfaceItem& item, const RayPacket& packet,
                        const CullingPacket& p, Mask rays, TreeScratch& scratch, Passes&& passes) {
  const std::uint32_t primitive = tree.literals_of(item).front().primitive;
  Mask ended = 0;
  MeshPacket mesh(tree.mesh_of(item), packet, p, rays, packet.t1.data(), item.is_opaque, scratch);
  mesh.crossings<Order::kAny>([&](std::size_t i, double t, bool entering) {
    if (passes(i, Crossing{t, primitive, item.object, entering})) return true;
    ended |= Mask{1} << i;
    return false;
  });
  return ended;
}

Mask FirstCrossings(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
                    Crossing* found) {
  CullingPacket p(packet);
  const SingleRays single(packet, p);
  HWY_ALIGN double t1[kRays];
  Mask any = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    t1[i] = i < packet.count ? packet.t1[i] : -kInf;
    if (i < packet.count) found[i].t = packet.t1[i];
  }
  const auto shorten = [&](std::size_t i) {
    any |= Mask{1} << i;
    t1[i] = found[i].t;
    p.last[i] = float_up(found[i].t);
  };
  const auto take_single = [&](std::uint32_t index, std::size_t i) {
    bool has = (any >> i & 1) != 0;
    take_first_crossing(tree, index, single[i], packet.t0[i], scratch, found[i], has);
    if (has) shorten(i);
  };
  const auto take_mesh = [&](const SurfaceItem& it, Mask rays) {
    first_crossings_of_mesh(tree, it, packet, p, rays, any, scratch, t1, found, shorten);
  };
  LaneItem lanes;
  const auto item = [&](std::uint32_t index, Mask rays) {
    const SurfaceItem& it = tree.items()[index];
    if (it.is_mesh && has_many(rays)) {
      take_mesh(it, rays);
      rays = 0;
    }
    const auto take = [&](std::size_t first, std::uint32_t group) {
      group = lanes.meet(tree, it, packet, p, first, t1, group, scratch);
      for (const std::size_t lane : SetBits(group)) {
        const std::size_t i = first + lane;
        // At equal t the first object wins.
        const bool wins_ties = (any >> i & 1) != 0 && it.object < found[i].object;
        double begin = packet.t0[i];
        double end = wins_ties ? std::nextafter(t1[i], kInf) : t1[i];
        if (!tree.clip_to_cell(it, single[i], begin, end)) continue;
        lanes.crossings(tree, it, lane, begin, end, [&](const Crossing& c) {
          found[i] = c;
          shorten(i);
          return false;
        });
      }
    };
    if (it.is_small) lanes.look_at(tree, it, p, rays);
    in_groups(it, p, rays, take, [&](std::size_t i) { take_single(index, i); });
    p.update_last_of_all();
  };
  const auto walk = [&](std::uint32_t node, std::size_t i) {
    each_item_below<Order::kNearestFirst>(
        tree.nodes(), node, p.ray(i), p.first[i], [&] { return found[i].t; }, scratch,
        [&](std::uint32_t index) {
          take_single(index, i);
          return true;
        });
    p.update_last_of_all();
  };
  const Mask active = packet.all();
  each_item_of_packet<Order::kNearestFirst>(tree, p, active, scratch, item, walk);
  return any;
}

/// The rays that no opaque surface ends; `light` is dimmed by the transparent surfaces that they
/// cross.
Mask PassLights(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
                Rgb* light) {
  const CullingPacket p(packet);
  const SingleRays single(packet, p);
  Mask active = packet.all();
  auto& panes = scratch.panes;
  panes.clear();
  /// False for an opaque surface, which ends the ray.
  const auto passes = [&](std::size_t i, const Crossing& c) {
    const double transmit = tree.transmit_of(c.primitive);
    if (transmit > 0) panes.push_back({i, c.t, c.object, transmit});
    return transmit > 0;
  };
  std::uint32_t& last = scratch.last_occluder[octant(packet.ray(0).direction)];
  const auto end_rays = [&](std::uint32_t index, Mask rays) {
    active &= ~rays;
    last = index;
  };
  const auto take_single = [&](std::uint32_t index, std::size_t i) {
    const bool lasts =
        tree.for_each_item_crossing(tree.items()[index], single[i], packet.t0[i], packet.t1[i],
                                    scratch, [&](const Crossing& c) { return passes(i, c); });
    if (!lasts) end_rays(index, Mask{1} << i);
  };
  const auto take_mesh = [&](std::uint32_t index, Mask rays) {
    const SurfaceItem& it = tree.items()[index];
    const Mask ended = rays_ended_by_mesh(tree, it, packet, p, rays, scratch, passes);
    if (ended != 0) end_rays(index, ended);
  };
  LaneItem lanes;
  const auto item = [&](std::uint32_t index, Mask rays) {
    const SurfaceItem& it = tree.items()[index];
    if (it.is_mesh && has_many(rays)) {
      take_mesh(index, rays);
      rays = 0;
    }
    const auto take = [&](std::size_t first, std::uint32_t group) {
      group = lanes.meet(tree, it, packet, p, first, packet.t1.data(), group, scratch);
      std::uint32_t ended = lanes.crossed & group;
      if (!lanes.is_convex || !it.is_opaque) {
        ended = 0;
        for (const std::size_t lane : SetBits(group)) {
          if (!lanes.crossings(tree, it, lane, lanes.begins[lane], lanes.ends[lane],
                               [&](const Crossing& c) { return passes(first + lane, c); })) {
            ended |= std::uint32_t{1} << lane;
          }
        }
      }
      if (ended != 0) end_rays(index, ended << first);
    };
    if (it.is_small) lanes.look_at(tree, it, p, rays);
    in_groups(it, p, rays, take, [&](std::size_t i) { take_single(index, i); });
  };
  const auto walk = [&](std::uint32_t node, std::size_t i) {
    each_item_below<Order::kAny>(
        tree.nodes(), node, p.ray(i), p.first[i], [&] { return packet.t1[i]; }, scratch,
        [&](std::uint32_t index) {
          take_single(index, i);
          return (active >> i & 1) != 0;
        });
  };
  // Neighbouring rays towards one light mostly end on the same object.
  if (last < tree.items().size()) item(last, active);
  panes.clear();
  each_item_of_packet<Order::kAny>(tree, p, active, scratch, item, walk);
  dim(panes, light);
  return active;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(FirstCrossings);
GRAYCUBE_SIMD_TABLE(PassLights);

RayPacket::Mask SurfaceTree::first_crossings(const RayPacket& packet, TreeScratch& scratch,
                                             std::span<Crossing, RayPacket::kSize> found) const {
  if (packet.count == 0) return 0;
  return GRAYCUBE_SIMD_CALL(FirstCrossings)(*this, packet, scratch, found.data());
}

RayPacket::Mask SurfaceTree::pass_lights(const RayPacket& packet, TreeScratch& scratch,
                                         std::span<Rgb, RayPacket::kSize> light) const {
  if (packet.count == 0) return 0;
  return GRAYCUBE_SIMD_CALL(PassLights)(*this, packet, scratch, light.data());
}

}  // namespace graycube
#endif
