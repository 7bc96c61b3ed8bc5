// Packets of rays through the surface tree. A whole packet passes a node's eight boxes at once, by the bounds
// of its rays (interval arithmetic: the float operations are monotonic, so what no ray's own test would let
// pass, and more, is all that is culled); on the way down each box is tested by each ray. Where few rays are
// left, they go on singly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "space/ray_packet.hpp"
#include "space/surface_tree.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "space/packet_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "space/packet_intervals-inl.hpp"
#include "space/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

using Mask = RayPacket::Mask;
constexpr std::size_t kRays = RayPacket::kSize;
/// So many rays or fewer are walked singly: a node costs a packet about three single visits.
constexpr int kFewRays = 2;

using FloatLanes = hn::CappedTag<float, 16>;

HWY_INLINE std::size_t first_ray(Mask mask) {
  return static_cast<std::size_t>(__builtin_ctz(mask));
}

/// The packet as the boxes see it.
struct CullingPacket {
  explicit CullingPacket(const RayPacket& packet) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& direction = padded(packet.direction[a], packet.count);
      for (std::size_t i = 0; i < kRays; ++i) inverse[a][i] = 1.0 / direction[i];
      set_axis(a, padded(packet.origin[a], packet.count), direction);
    }
    for (std::size_t i = 0; i < packet.count; ++i) {
      first[i] = float_down(packet.t0[i]);
      last[i] = float_up(packet.t1[i]);
      const double sum = inverse[0][i] + inverse[1][i] + inverse[2][i];
      if (!std::isfinite(sum)) odd |= Mask{1} << i;
    }
    for (std::size_t i = packet.count; i < kRays; ++i) {
      first[i] = first[0];
      last[i] = -std::numeric_limits<float>::infinity();
    }
    first_of_all = *std::min_element(first.begin(), first.end());
    update_last_of_all();
  }

  void update_last_of_all() {
    const FloatLanes d;
    auto greatest = hn::Load(d, last.data());
    for (std::size_t i = hn::Lanes(d); i < kRays; i += hn::Lanes(d)) {
      greatest = hn::Max(greatest, hn::Load(d, last.data() + i));
    }
    last_of_all = hn::GetLane(hn::MaxOfLanes(d, greatest));
  }

  CullingRay ray(std::size_t i) const {
    CullingRay r;
    for (std::size_t a = 0; a < 3; ++a) {
      r.near_inverse[a] = near_inverse[a][i];
      r.far_inverse[a] = far_inverse[a][i];
      r.near_origin[a] = near_origin[a][i];
      r.far_origin[a] = far_origin[a][i];
      r.near_side[a] = near_inverse[a][i] < 0 ? 1 : 0;
    }
    return r;
  }

  using Floats = std::array<float, kRays>;
  using DoublesOfAll = std::array<double, kRays>;

  alignas(64) std::array<Floats, 3> near_inverse, far_inverse, near_origin, far_origin;
  /// The stretch of each ray that is still of interest.
  alignas(64) Floats first, last;
  alignas(64) std::array<std::array<double, kRays>, 3> inverse;
  /// Rays parallel to a coordinate plane: their items are looked up singly.
  Mask odd = 0;

  // Bounds over all rays.
  float first_of_all = 0, last_of_all = 0;
  std::array<float, 3> least_near_inverse, greatest_near_inverse, least_far_inverse,
      greatest_far_inverse, extreme_near_origin, extreme_far_origin;
  std::array<std::size_t, 3> near_side;
  /// Rays go both ways along the axis: it says nothing about all of them.
  std::array<bool, 3> is_mixed;

 private:
  /// Empty places repeat the first ray.
  const DoublesOfAll& padded(const DoublesOfAll& v, std::size_t count) {
    if (count == kRays) return v;
    DoublesOfAll& copy = padding[next_padding++ % padding.size()];
    for (std::size_t i = 0; i < kRays; ++i) copy[i] = v[i < count ? i : 0];
    return copy;
  }

  /// As CullingAxis for every ray, and the bounds of what comes out.
  void set_axis(std::size_t a, const DoublesOfAll& origin, const DoublesOfAll& direction) {
    alignas(64) Floats o, u;
    for (std::size_t i = 0; i < kRays; ++i) {
      o[i] = static_cast<float>(origin[i]);
      u[i] = static_cast<float>(direction[i]);
    }
    const FloatLanes d;
    Bounds near_inverses, far_inverses, near_origins, far_origins;
    for (std::size_t i = 0; i < kRays; i += hn::Lanes(d)) {
      const auto f = hn::Load(d, o.data() + i);
      const auto error = hn::Add(hn::Mul(hn::Abs(f), hn::Set(d, 1.2e-7f)), hn::Set(d, 1e-37f));
      const auto given = hn::Load(d, u.data() + i);
      const auto flattest = hn::Set(d, kFlattest);
      const auto steep = hn::IfThenElse(hn::Lt(hn::Abs(given), flattest),
                                        hn::CopySign(flattest, given), given);
      const auto downward = hn::Lt(steep, hn::Zero(d));
      const auto inverses = hn::Div(hn::Set(d, 1.0f), steep);
      const auto before = hn::Sub(f, error);
      const auto behind = hn::Add(f, error);
      near_inverses.keep(near_inverse[a], i, hn::Mul(inverses, hn::Set(d, 1 - kSlack)));
      far_inverses.keep(far_inverse[a], i, hn::Mul(inverses, hn::Set(d, 1 + kSlack)));
      near_origins.keep(near_origin[a], i, hn::IfThenElse(downward, before, behind));
      far_origins.keep(far_origin[a], i, hn::IfThenElse(downward, behind, before));
    }
    least_near_inverse[a] = near_inverses.least();
    greatest_near_inverse[a] = near_inverses.greatest();
    least_far_inverse[a] = far_inverses.least();
    greatest_far_inverse[a] = far_inverses.greatest();
    is_mixed[a] = least_near_inverse[a] < 0 && greatest_near_inverse[a] > 0;
    near_side[a] = least_near_inverse[a] < 0 ? 1 : 0;
    // The origin that brings the near plane nearest, and the far one farthest.
    const bool up = near_side[a] == 0;
    extreme_near_origin[a] = up ? near_origins.greatest() : near_origins.least();
    extreme_far_origin[a] = up ? far_origins.least() : far_origins.greatest();
  }

  /// Stores lanes, and keeps their least and greatest.
  struct Bounds {
    using V = hn::Vec<FloatLanes>;
    HWY_INLINE Bounds()
        : lo(hn::Set(FloatLanes(), std::numeric_limits<float>::infinity())), hi(hn::Neg(lo)) {}
    HWY_INLINE void keep(Floats& to, std::size_t i, V v) {
      hn::Store(v, FloatLanes(), to.data() + i);
      lo = hn::Min(lo, v);
      hi = hn::Max(hi, v);
    }
    HWY_INLINE float least() const { return hn::GetLane(hn::MinOfLanes(FloatLanes(), lo)); }
    HWY_INLINE float greatest() const { return hn::GetLane(hn::MaxOfLanes(FloatLanes(), hi)); }
    V lo, hi;
  };

  std::array<DoublesOfAll, 2> padding;
  std::size_t next_padding = 0;
};

/// Which of a node's boxes may any ray of the packet meet, and from where on?
HWY_INLINE std::uint32_t meet_all(const WideNode& node, const CullingPacket& p,
                                  float* HWY_RESTRICT near) {
  const hn::CappedTag<float, WideNode::kWidth> d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < WideNode::kWidth; i += lanes) {
    auto from = hn::Set(d, p.first_of_all);
    auto to = hn::Set(d, p.last_of_all);
    for (std::size_t a = 0; a < 3; ++a) {
      if (p.is_mixed[a]) continue;
      const auto near_plane = hn::Load(d, node.planes[p.near_side[a]][a].data() + i);
      const auto far_plane = hn::Load(d, node.planes[1 - p.near_side[a]][a].data() + i);
      const auto to_near = hn::Sub(near_plane, hn::Set(d, p.extreme_near_origin[a]));
      const auto to_far = hn::Sub(far_plane, hn::Set(d, p.extreme_far_origin[a]));
      from = hn::Max(from, hn::Min(hn::Mul(to_near, hn::Set(d, p.least_near_inverse[a])),
                                   hn::Mul(to_near, hn::Set(d, p.greatest_near_inverse[a]))));
      to = hn::Min(to, hn::Max(hn::Mul(to_far, hn::Set(d, p.least_far_inverse[a])),
                               hn::Mul(to_far, hn::Set(d, p.greatest_far_inverse[a]))));
    }
    hn::StoreU(from, d, near + i);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Le(from, to), bits);
    mask |= static_cast<std::uint32_t>(bits[0] & ((1u << lanes) - 1)) << i;
  }
  return mask;
}

/// Which of the rays may meet one box of a node? By the arithmetic of `meet`.
HWY_INLINE Mask meet_each(const WideNode& node, std::size_t slot, const CullingPacket& p,
                          Mask rays) {
  const FloatLanes d;
  const std::size_t lanes = hn::Lanes(d);
  Mask mask = 0;
  for (std::size_t i = 0; i < kRays; i += lanes) {
    if (((rays >> i) & ((Mask{1} << lanes) - 1)) == 0) continue;
    auto from = hn::Load(d, p.first.data() + i);
    auto to = hn::Load(d, p.last.data() + i);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto near_inverse = hn::Load(d, p.near_inverse[a].data() + i);
      auto near_plane = hn::Set(d, node.planes[p.near_side[a]][a][slot]);
      auto far_plane = hn::Set(d, node.planes[1 - p.near_side[a]][a][slot]);
      if (p.is_mixed[a]) {  // near_side is 1 then
        const auto upward = hn::Gt(near_inverse, hn::Zero(d));
        const auto upper = near_plane;
        near_plane = hn::IfThenElse(upward, far_plane, upper);
        far_plane = hn::IfThenElse(upward, upper, far_plane);
      }
      const auto enter =
          hn::Mul(hn::Sub(near_plane, hn::Load(d, p.near_origin[a].data() + i)), near_inverse);
      const auto leave = hn::Mul(hn::Sub(far_plane, hn::Load(d, p.far_origin[a].data() + i)),
                                 hn::Load(d, p.far_inverse[a].data() + i));
      from = hn::Max(from, enter);
      to = hn::Min(to, leave);
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Le(from, to), bits);
    const Mask met = bits[0] | (static_cast<Mask>(bits[1]) << 8);
    mask |= (met & ((Mask{1} << lanes) - 1)) << i;
  }
  return mask & rays;
}

/// Takes a packet through the tree: calls item(index, rays) for each item that any of the packet's rays may
/// meet, with those rays; and walk(node, ray) for a subtree that one of few rays
/// is left to visit. Rays that `active` drops in the meantime are left out.
template <Order order, typename Item, typename Walk>
void each_item_of_packet(const SurfaceTree& tree, const CullingPacket& p, const Mask& active,
                         TreeScratch& scratch, Item&& item, Walk&& walk) {
  for (const std::uint32_t i : tree.unbounded_items()) {
    if (active != 0) item(i, active);
  }
  if (tree.nodes().empty() || active == 0) return;
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
    std::uint32_t mask = meet_all(node, p, near);
    const std::size_t base = size;
    while (mask != 0) {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(mask));
      mask &= mask - 1;
      std::size_t at = size++;
      if constexpr (order == Order::kNearestFirst) at = make_place(stack, base, at, near[i]);
      stack[at] = {&node, near[i], i, rays};
    }
  };
  visit(tree.nodes().front(), active);
  while (size > 0) {
    const StackEntry top = stack[--size];
    if (top.t > p.last_of_all) continue;
    const Mask rays = meet_each(*top.node, top.slot, p, top.rays & active);
    if (rays == 0) continue;
    const std::uint32_t child = top.node->child[top.slot];
    if ((child & WideNode::kItemFlag) != 0) {
      item(child & ~WideNode::kItemFlag, rays);
      if (active == 0) return;
    } else if (__builtin_popcount(rays) <= kFewRays) {
      for (Mask rest = rays; rest != 0; rest &= rest - 1) walk(child, first_ray(rest));
      if (active == 0) return;
    } else {
      visit(tree.nodes()[child], rays);
    }
  }
}

/// The intervals of a flat item's literals along the rays of one group of lanes.
class LaneItem {
 public:
  /// Lanes of the group, from ray `first` on, whose common interval of the upright literals meets [t0, t1].
  std::uint32_t meet(const SurfaceTree& tree, const SurfaceItem& item, const RayPacket& packet,
                     const CullingPacket& p, std::size_t first, const double* t1,
                     std::uint32_t lanes_wanted, TreeScratch& scratch) {
    const Lanes d;
    const auto load = [&](const auto& v) {
      return LaneVec{hn::Load(d, v[0].data() + first), hn::Load(d, v[1].data() + first),
                     hn::Load(d, v[2].data() + first)};
    };
    const LaneRays rays{load(packet.origin), load(packet.direction), load(p.inverse)};
    Doubles begin = hn::Load(d, packet.t0.data() + first);
    Doubles end = hn::Load(d, t1 + first);
    if (item.cell != SurfaceItem::kAllSpace) clip_to_cell(tree.cell_of(item), rays, begin, end);
    LaneInterval common = LaneInterval::whole();
    has_removed = false;
    const auto literals = tree.literals_of(item);
    for (std::size_t i = 0; i < literals.size(); ++i) {
      scratch.counts.primitives_tested += static_cast<unsigned>(__builtin_popcount(lanes_wanted));
      const LaneInterval own = lane_interval_of(literals[i], tree.model(), rays);
      hn::Store(own.enter, d, enter[i]);
      hn::Store(own.leave, d, leave[i]);
      if (literals[i].is_inverted) {
        has_removed = true;
        continue;
      }
      common.enter_after(own.enter);
      common.leave_before(own.leave);
      // At equal t the item may still win a tie.
      const auto alive =
          hn::And(hn::Lt(common.enter, common.leave),
                  hn::And(hn::Ge(common.leave, begin), hn::Le(common.enter, end)));
      lanes_wanted &= bits_of(alive);
      if (lanes_wanted == 0) return 0;
    }
    const auto crosses = hn::Or(hn::And(hn::Ge(common.enter, begin), hn::Lt(common.enter, end)),
                                hn::Lt(common.leave, end));
    crossed = lanes_wanted & bits_of(crosses);
    hn::Store(common.enter, d, from);
    hn::Store(common.leave, d, to);
    hn::Store(begin, d, begins);
    hn::Store(end, d, ends);
    return lanes_wanted;
  }

  static std::uint32_t bits_of(LaneMask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Lanes(), mask, bits);
    return (bits[0] | (static_cast<std::uint32_t>(bits[1]) << 8)) &
           ((std::uint32_t{1} << hn::Lanes(Lanes())) - 1);
  }

  /// Calls visit(Crossing) for the lane's crossings in [t0, t1), in order, until it returns false.
  template <typename Visit>
  bool crossings(const SurfaceTree& tree, const SurfaceItem& item, std::size_t lane, double t0,
                 double t1, Visit&& visit) const {
    const auto literals = tree.literals_of(item);
    std::array<csg::Interval, crossings::kMaxFlatLiterals> removed;
    std::size_t removed_count = 0;
    if (has_removed) {
      for (std::size_t i = 0; i < literals.size(); ++i) {
        if (literals[i].is_inverted && enter[i][lane] < leave[i][lane]) {
          removed[removed_count++] = {enter[i][lane], leave[i][lane]};
        }
      }
    }
    const auto interval = [&](std::size_t i) { return csg::Interval{enter[i][lane], leave[i][lane]}; };
    const auto at_end = [&](double t, bool entering) {
      return visit(Crossing{t, crossings::changed_literal(literals, interval, t), item.object,
                            entering != item.is_complement});
    };
    return crossings::conjunction_ends({removed.data(), removed_count}, from[lane], to[lane], t0, t1,
                                       at_end);
  }

  /// Lanes that cross an end of the common interval. Unless `has_removed`, these are just those that cross
  /// the item's surface.
  std::uint32_t crossed = 0;
  bool has_removed = false;

  static constexpr std::size_t kMaxLanes = 16;
  HWY_ALIGN double from[kMaxLanes], to[kMaxLanes], begins[kMaxLanes], ends[kMaxLanes];
  HWY_ALIGN double enter[crossings::kMaxFlatLiterals][kMaxLanes];
  HWY_ALIGN double leave[crossings::kMaxFlatLiterals][kMaxLanes];

 private:
  /// The expressions of SurfaceTree::clip_to_cell.
  static void clip_to_cell(const Aabb& cell, const LaneRays& rays, Doubles& begin, Doubles& end) {
    const auto clip = [&](double lo, double hi, Doubles o, Doubles inverse) {
      const Doubles a = hn::Mul(hn::Sub(every(lo), o), inverse);
      const Doubles b = hn::Mul(hn::Sub(every(hi), o), inverse);
      const LaneMask upward = hn::Gt(inverse, hn::Zero(Lanes()));
      const Doubles enters = hn::IfThenElse(upward, a, b);
      const Doubles leaves = hn::IfThenElse(upward, b, a);
      begin = hn::IfThenElse(hn::Gt(enters, begin), enters, begin);
      end = hn::IfThenElse(hn::Lt(leaves, end), leaves, end);
    };
    clip(cell.lo.x, cell.hi.x, rays.origin.x, rays.inverse.x);
    clip(cell.lo.y, cell.hi.y, rays.origin.y, rays.inverse.y);
    clip(cell.lo.z, cell.hi.z, rays.origin.z, rays.inverse.z);
  }
};

/// The packet's rays, one by one, as the items see them.
class SingleRays {
 public:
  SingleRays(const RayPacket& packet, const CullingPacket& culling)
      : packet_(packet), culling_(culling) {}
  PreparedRay operator[](std::size_t i) const {
    return {packet_.ray(i),
            {culling_.inverse[0][i], culling_.inverse[1][i], culling_.inverse[2][i]}};
  }

 private:
  const RayPacket& packet_;
  const CullingPacket& culling_;
};

/// Calls take(group's first ray, lanes) for the groups of lanes with rays that can go through the item
/// together, and single(ray) for the others.
template <typename Take, typename Single>
HWY_INLINE void in_groups(const SurfaceItem& item, const CullingPacket& p, Mask rays, Take&& take,
                          Single&& single) {
  const std::size_t lanes = hn::Lanes(Lanes());
  const Mask alone = item.has_lanes ? rays & p.odd : rays;
  for (Mask rest = alone; rest != 0; rest &= rest - 1) single(first_ray(rest));
  const Mask together = rays & ~alone;
  for (std::size_t first = 0; first < kRays; first += lanes) {
    const Mask group = (together >> first) & ((Mask{1} << lanes) - 1);
    if (group != 0) take(first, group);
  }
}

Mask FirstCrossings(const SurfaceTree& tree, const RayPacket& packet, TreeScratch& scratch,
                    Crossing* found) {
  CullingPacket p(packet);
  const SingleRays single(packet, p);
  HWY_ALIGN double t1[kRays];
  Mask any = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    t1[i] = i < packet.count ? packet.t1[i] : -csg::kInf;
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
  LaneItem lanes;
  const auto item = [&](std::uint32_t index, Mask rays) {
    const SurfaceItem& it = tree.items()[index];
    const auto take = [&](std::size_t first, std::uint32_t group) {
      group = lanes.meet(tree, it, packet, p, first, t1, group, scratch);
      for (; group != 0; group &= group - 1) {
        const std::size_t lane = first_ray(group);
        const std::size_t i = first + lane;
        // At equal t the first object wins.
        const bool wins_ties = (any >> i & 1) != 0 && it.object < found[i].object;
        double begin = packet.t0[i];
        double end = wins_ties ? std::nextafter(t1[i], Aabb::kInf) : t1[i];
        if (!tree.clip_to_cell(it, single[i], begin, end)) continue;
        lanes.crossings(tree, it, lane, begin, end, [&](const Crossing& c) {
          found[i] = c;
          shorten(i);
          return false;
        });
      }
    };
    in_groups(it, p, rays, take, [&](std::size_t i) { take_single(index, i); });
    p.update_last_of_all();
  };
  const auto walk = [&](std::uint32_t node, std::size_t i) {
    each_item_below<Order::kNearestFirst>(tree, node, p.ray(i), p.first[i], [&] { return found[i].t; }, scratch,
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

/// The rays that no opaque surface ends; what they lose to transparent ones is taken from their light.
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
    const bool lasts = tree.for_each_item_crossing(
        tree.items()[index], single[i], packet.t0[i], packet.t1[i], scratch,
        [&](const Crossing& c) { return passes(i, c); });
    if (!lasts) end_rays(index, Mask{1} << i);
  };
  LaneItem lanes;
  const auto item = [&](std::uint32_t index, Mask rays) {
    const SurfaceItem& it = tree.items()[index];
    const auto take = [&](std::size_t first, std::uint32_t group) {
      group = lanes.meet(tree, it, packet, p, first, packet.t1.data(), group, scratch);
      std::uint32_t ended = lanes.crossed & group;
      if (lanes.has_removed || !it.is_opaque) {
        ended = 0;
        for (; group != 0; group &= group - 1) {
          const std::size_t lane = first_ray(group);
          if (!lanes.crossings(tree, it, lane, lanes.begins[lane], lanes.ends[lane],
                               [&](const Crossing& c) { return passes(first + lane, c); })) {
            ended |= std::uint32_t{1} << lane;
          }
        }
      }
      if (ended != 0) end_rays(index, ended << first);
    };
    in_groups(it, p, rays, take, [&](std::size_t i) { take_single(index, i); });
  };
  const auto walk = [&](std::uint32_t node, std::size_t i) {
    each_item_below<Order::kAny>(tree, node, p.ray(i), p.first[i], [&] { return packet.t1[i]; },
                                 scratch, [&](std::uint32_t index) {
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

HWY_EXPORT(FirstCrossings);
HWY_EXPORT(PassLights);

RayPacket::Mask SurfaceTree::first_crossings(const RayPacket& packet, TreeScratch& scratch,
                                             std::span<Crossing, RayPacket::kSize> found) const {
  if (packet.count == 0) return 0;
  return HWY_DYNAMIC_DISPATCH(FirstCrossings)(*this, packet, scratch, found.data());
}

RayPacket::Mask SurfaceTree::pass_lights(const RayPacket& packet, TreeScratch& scratch,
                                         std::span<Rgb, RayPacket::kSize> light) const {
  if (packet.count == 0) return 0;
  return HWY_DYNAMIC_DISPATCH(PassLights)(*this, packet, scratch, light.data());
}

}  // namespace graycube
#endif
