// An item of the surface tree along the rays of a packet, as many at a time as there are lanes of doubles.
#if defined(GRAYCUBE_SPACE_LANE_ITEM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_LANE_ITEM_INL
#undef GRAYCUBE_SPACE_LANE_ITEM_INL
#else
#define GRAYCUBE_SPACE_LANE_ITEM_INL
#endif

#include <hwy/highway.h>

#include "space/packet_culling-inl.hpp"
#include "space/packet_intervals-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

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
    std::array<crossings::Ends, crossings::kMaxFlatLiterals> removed;
    std::size_t removed_count = 0;
    if (has_removed) {
      for (std::size_t i = 0; i < literals.size(); ++i) {
        if (literals[i].is_inverted && enter[i][lane] < leave[i][lane]) {
          removed[removed_count++] = {enter[i][lane], leave[i][lane]};
        }
      }
    }
    const auto interval = [&](std::size_t i) { return crossings::Ends{enter[i][lane], leave[i][lane]}; };
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

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
