// Packets of rays through the surface tree. A whole packet is tested against a node's eight boxes
// at once, by the bounds of its rays (float operations are monotonic, so only what each ray's own
// test would cull is culled); then each child by each ray, when its turn comes. Where few rays are
// left, they go on singly.
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

/// Whether it pays to take the rays through a mesh together.
bool has_many(Mask rays) { return __builtin_popcount(rays) > kFewRays; }

/// Takes a packet through the tree, as each_leaf_of_packet, and through the items without bounds
/// first.
template <Order order, typename Item, typename Walk>
void each_item_of_packet(const SurfaceTree& tree, const CullingPacket& p, const Mask& active,
                         TreeScratch& scratch, Item&& item, Walk&& walk) {
  for (const std::uint32_t i : tree.unbounded_items()) {
    if (active != 0) item(i, active);
  }
  each_leaf_of_packet<order>(tree.nodes(), p, active, scratch, item, walk);
}

/// The first crossing of each ray of a packet.
class FirstOfEach {
 public:
  FirstOfEach(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
              Crossing* found)
      : tree_(tree),
        packet_(packet),
        scratch_(scratch),
        found_(found),
        p_(packet),
        single_(packet, p_) {
    for (std::size_t i = 0; i < kRays; ++i) {
      t1_[i] = i < packet.count ? packet.t1[i] : -kInf;
      if (i < packet.count) found[i].t = packet.t1[i];
    }
  }

  /// The rays that cross anything.
  Mask run() {
    const Mask active = packet_.all();
    each_item_of_packet<Order::kNearestFirst>(
        tree_, p_, active, scratch_,
        [this](std::uint32_t index, Mask rays) { take_item(index, rays); },
        [this](std::uint32_t node, std::size_t i) { walk(node, i); });
    return any_;
  }

 private:
  void shorten(std::size_t i) {
    any_ |= Mask{1} << i;
    t1_[i] = found_[i].t;
    p_.last[i] = float_up(found_[i].t);
  }

  /// Where the ray's search for an item's crossings ends: at equal t the first object wins.
  double end_for(const SurfaceItem& item, std::size_t i) const {
    const bool wins_ties = (any_ >> i & 1) != 0 && item.object < found_[i].object;
    return wins_ties ? std::nextafter(t1_[i], kInf) : t1_[i];
  }

  void take_single(std::uint32_t index, std::size_t i) {
    bool has = (any_ >> i & 1) != 0;
    take_first_crossing(tree_, index, single_[i], packet_.t0[i], scratch_, found_[i], has);
    if (has) shorten(i);
  }

  void take_mesh(const SurfaceItem& item, Mask rays) {
    const Literal& literal = tree_.literals_of(item).front();
    const bool swaps = literal.is_inverted != item.is_complement;
    HWY_ALIGN double end[kRays];
    for (std::size_t i = 0; i < kRays; ++i) end[i] = end_for(item, i);
    MeshPacket mesh(tree_.mesh_of(item), packet_, p_, rays, end, true, scratch_);
    mesh.crossings<Order::kNearestFirst>([&](std::size_t i, double t, bool entering) {
      found_[i] = {t, literal.primitive, item.object, entering != swaps};
      shorten(i);
      return false;
    });
  }

  void take_lanes(const SurfaceItem& item, std::size_t first, std::uint32_t group) {
    group = lanes_.meet(tree_, item, packet_, p_, first, t1_, group, scratch_);
    for (const std::size_t lane : SetBits(group)) {
      const std::size_t i = first + lane;
      double begin = packet_.t0[i];
      double end = end_for(item, i);
      if (!tree_.clip_to_cell(item, single_[i], begin, end)) continue;
      lanes_.crossings(tree_, item, lane, begin, end, [&](const Crossing& c) {
        found_[i] = c;
        shorten(i);
        return false;
      });
    }
  }

  void take_item(std::uint32_t index, Mask rays) {
    const SurfaceItem& item = tree_.items()[index];
    if (item.is_mesh && has_many(rays)) {
      take_mesh(item, rays);
      rays = 0;
    }
    if (item.is_small) lanes_.look_at(tree_, item, p_, rays);
    in_groups(
        item, p_, rays,
        [&](std::size_t first, std::uint32_t group) { take_lanes(item, first, group); },
        [&](std::size_t i) { take_single(index, i); });
    p_.update_last_of_all();
  }

  void walk(std::uint32_t node, std::size_t i) {
    each_item_below<Order::kNearestFirst>(
        tree_.nodes(), node, p_.ray(i), p_.first[i], [&] { return found_[i].t; }, scratch_,
        [&](std::uint32_t index) {
          take_single(index, i);
          return true;
        });
    p_.update_last_of_all();
  }

  const SurfaceTree& tree_;
  const RayPacket& packet_;
  TreeScratch& scratch_;
  Crossing* const found_;
  CullingPacket p_;
  SingleRays single_;
  /// By ray: where its search ends by now.
  HWY_ALIGN double t1_[kRays];
  Mask any_ = 0;
  LaneItem lanes_;
};

Mask FirstCrossings(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
                    Crossing* found) {
  return FirstOfEach(tree, packet, scratch, found).run();
}

/// The rays of a packet that no opaque surface ends; what they lose to transparent ones is taken
/// from their light.
class LightThrough {
 public:
  LightThrough(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch)
      : tree_(tree),
        packet_(packet),
        scratch_(scratch),
        p_(packet),
        single_(packet, p_),
        active_(packet.all()),
        last_(scratch.last_occluder[octant(packet.ray(0).direction)]) {}

  Mask run(Rgb* light) {
    scratch_.panes.clear();
    // Neighbouring rays towards one light mostly end on the same object.
    if (last_ < tree_.items().size()) take_item(last_, active_);
    scratch_.panes.clear();
    each_item_of_packet<Order::kAny>(
        tree_, p_, active_, scratch_,
        [this](std::uint32_t index, Mask rays) { take_item(index, rays); },
        [this](std::uint32_t node, std::size_t i) { walk(node, i); });
    dim(scratch_.panes, light);
    return active_;
  }

 private:
  /// False for an opaque surface, which ends the ray.
  bool passes(std::size_t i, const Crossing& c) {
    const double transmit = tree_.transmit_of(c.primitive);
    if (transmit > 0) scratch_.panes.push_back({i, c.t, c.object, transmit});
    return transmit > 0;
  }

  void end_rays(std::uint32_t index, Mask rays) {
    active_ &= ~rays;
    last_ = index;
  }

  void take_single(std::uint32_t index, std::size_t i) {
    const bool lasts =
        tree_.for_each_item_crossing(tree_.items()[index], single_[i], packet_.t0[i], packet_.t1[i],
                                     scratch_, [&](const Crossing& c) { return passes(i, c); });
    if (!lasts) end_rays(index, Mask{1} << i);
  }

  void take_mesh(std::uint32_t index, Mask rays) {
    const SurfaceItem& item = tree_.items()[index];
    const std::uint32_t primitive = tree_.literals_of(item).front().primitive;
    Mask ended = 0;
    MeshPacket mesh(tree_.mesh_of(item), packet_, p_, rays, packet_.t1.data(), item.is_opaque,
                    scratch_);
    mesh.crossings<Order::kAny>([&](std::size_t i, double t, bool entering) {
      if (passes(i, Crossing{t, primitive, item.object, entering})) return true;
      ended |= Mask{1} << i;
      return false;
    });
    if (ended != 0) end_rays(index, ended);
  }

  void take_lanes(std::uint32_t index, const SurfaceItem& item, std::size_t first,
                  std::uint32_t group) {
    group = lanes_.meet(tree_, item, packet_, p_, first, packet_.t1.data(), group, scratch_);
    std::uint32_t ended = lanes_.crossed & group;
    if (!lanes_.is_convex || !item.is_opaque) {
      ended = 0;
      for (const std::size_t lane : SetBits(group)) {
        if (!lanes_.crossings(tree_, item, lane, lanes_.begins[lane], lanes_.ends[lane],
                              [&](const Crossing& c) { return passes(first + lane, c); })) {
          ended |= std::uint32_t{1} << lane;
        }
      }
    }
    if (ended != 0) end_rays(index, ended << first);
  }

  void take_item(std::uint32_t index, Mask rays) {
    const SurfaceItem& item = tree_.items()[index];
    if (item.is_mesh && has_many(rays)) {
      take_mesh(index, rays);
      rays = 0;
    }
    if (item.is_small) lanes_.look_at(tree_, item, p_, rays);
    in_groups(
        item, p_, rays,
        [&](std::size_t first, std::uint32_t group) { take_lanes(index, item, first, group); },
        [&](std::size_t i) { take_single(index, i); });
  }

  void walk(std::uint32_t node, std::size_t i) {
    each_item_below<Order::kAny>(
        tree_.nodes(), node, p_.ray(i), p_.first[i], [&] { return packet_.t1[i]; }, scratch_,
        [&](std::uint32_t index) {
          take_single(index, i);
          return (active_ >> i & 1) != 0;
        });
  }

  const SurfaceTree& tree_;
  const RayPacket& packet_;
  TreeScratch& scratch_;
  const CullingPacket p_;
  SingleRays single_;
  Mask active_;
  /// The item that ended a ray in this direction last.
  std::uint32_t& last_;
  LaneItem lanes_;
};

Mask PassLights(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
                Rgb* light) {
  return LightThrough(tree, packet, scratch).run(light);
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
