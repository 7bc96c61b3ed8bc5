// Finds crossings of one item of the surface tree with a packet's rays, as many at a time as a
// vector has lanes of doubles.
#if defined(GRAYCUBE_SPACE_LANE_ITEM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_LANE_ITEM_INL
#undef GRAYCUBE_SPACE_LANE_ITEM_INL
#else
#define GRAYCUBE_SPACE_LANE_ITEM_INL
#endif

#include <hwy/highway.h>

#include "crossings/packet_culling-inl.hpp"
#include "crossings/packet_intervals-inl.hpp"
#include "set_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// The intervals of a small item's literals along the rays of one group of lanes.
class LaneItem {
 public:
  /// Finds which of a packet's rays may meet the bounds of each literal. To be called before the
  /// item's groups of lanes are taken.
  void look_at(const SurfaceTree& tree, const SurfaceItem& item, const CullingPacket& p,
               Mask rays) {
    const auto literals = tree.literals_of(item);
    has_near_ = false;
    if (literals.size() == 1) return;  // the tree has seen to its bounds
    for (std::size_t i = 0; i < literals.size(); ++i) {
      const Literal& l = literals[i];
      if (!crossings::has_bounds(l.kind) || (literals.size() <= kFewLiterals && is_cheap(l.kind))) {
        near_[i] = rays;
        continue;
      }
      has_near_ = true;
      near_[i] =
          meet_box([&](std::size_t side,
                       std::size_t a) { return static_cast<float>(csg::box_side(l.v, side, a)); },
                   p, rays);
    }
  }

  /// The lanes of the group from ray `first` on that may cross the item's surface in [t0, t1]: for
  /// a conjunction, those in which the common interval of the upright literals meets it.
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
    const bool is_flat = item.is_flat();
    is_convex = is_flat && item.is_simple;
    second_count_ = 0;
    const auto literals = tree.literals_of(item);
    for (std::size_t i = 0; i < literals.size(); ++i) {
      const Literal& literal = literals[i];
      const bool confines = is_flat && !literal.is_inverted;
      std::uint32_t wanted = lanes_wanted;
      if (has_near_) {
        wanted &= near_[i] >> first;
        if (confines) lanes_wanted = wanted;
        if (lanes_wanted == 0) return 0;
        if (wanted == 0) {
          hn::Store(every(kInf), d, enter[i]);
          hn::Store(every(-kInf), d, leave[i]);
          continue;
        }
      }
      scratch.counts.count_test(literal.kind, static_cast<unsigned>(__builtin_popcount(wanted)));
      LaneInterval own;
      if (item.is_simple || crossings::has_lane_interval(literal.kind)) {
        own = lane_interval_of(literal, tree.model(), rays);
        hn::Store(own.enter, d, enter[i]);
        hn::Store(own.leave, d, leave[i]);
      } else {
        own = one_by_one(tree.model(), literal, i, packet, first, wanted);
      }
      if (!confines) {
        is_convex = false;
        continue;
      }
      common.enter_after(own.enter);
      common.leave_before(own.leave);
      // At an equal t the item may still win a tie, so equality keeps a lane.
      const auto alive = hn::And(hn::Lt(common.enter, common.leave),
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
    if (!item.is_flat() || !item.is_simple) [[unlikely]] {
      return event_crossings(tree, item, lane, t0, t1, visit);
    }
    const auto literals = tree.literals_of(item);
    std::array<crossings::Ends, crossings::kMaxFlatLiterals> removed;
    std::size_t removed_count = 0;
    if (!is_convex) {
      for (std::size_t i = 0; i < literals.size(); ++i) {
        if (literals[i].is_inverted && enter[i][lane] < leave[i][lane]) {
          removed[removed_count++] = {enter[i][lane], leave[i][lane]};
        }
      }
    }
    const auto interval = [&](std::size_t i) {
      return crossings::Ends{enter[i][lane], leave[i][lane]};
    };
    const auto at_end = [&](double t, bool entering) {
      return visit(Crossing{t, crossings::changed_literal(literals, interval, t), item.object,
                            entering != item.is_complement});
    };
    return crossings::conjunction_ends({removed.data(), removed_count}, from[lane], to[lane], t0,
                                       t1, at_end);
  }

  /// Lanes that cross an end of the common interval. Where the item `is_convex`, these are just
  /// those that cross its surface.
  std::uint32_t crossed = 0;
  bool is_convex = false;

  static constexpr std::size_t kMaxLanes = 16;
  HWY_ALIGN double from[kMaxLanes], to[kMaxLanes], begins[kMaxLanes], ends[kMaxLanes];
  HWY_ALIGN double enter[crossings::kMaxFlatLiterals][kMaxLanes];
  HWY_ALIGN double leave[crossings::kMaxFlatLiterals][kMaxLanes];

 private:
  /// A lane's second interval.
  struct Second {
    std::uint32_t literal;
    std::size_t lane;
    double enter, leave;
  };

  /// Solves a literal for each wanted lane; returns the stretch from its first to its last
  /// interval.
  LaneInterval one_by_one(const Model& model, const Literal& literal, std::size_t index,
                          const RayPacket& packet, std::size_t first, std::uint32_t wanted) {
    const Lanes d;
    hn::Store(every(kInf), d, enter[index]);
    hn::Store(every(-kInf), d, leave[index]);
    HWY_ALIGN double last[kMaxLanes];
    hn::Store(every(-kInf), d, last);
    for (const std::size_t lane : SetBits(wanted)) {
      const Spans spans =
          spans_along(model.primitives[literal.primitive], model.data(), packet.ray(first + lane));
      if (spans.count == 0) continue;
      enter[index][lane] = spans.interval[0].enter;
      last[lane] = leave[index][lane] = spans.interval[0].leave;
      if (spans.count == 1) continue;
      const auto& second = spans.interval[1];
      last[lane] = second.leave;
      seconds_[second_count_++] = {static_cast<std::uint32_t>(index), lane, second.enter,
                                   second.leave};
    }
    return {hn::Load(d, enter[index]), hn::Load(d, last)};
  }

  /// Crossings of items that aren't simple conjunctions. Not inlined: most items don't come here.
  template <typename Visit>
  HWY_NOINLINE bool event_crossings(const SurfaceTree& tree, const SurfaceItem& item,
                                    std::size_t lane, double t0, double t1, Visit&& visit) const {
    crossings::FewEvents events(t0, t1);
    for (std::uint32_t i = 0; i < item.literal_count; ++i)
      events.add(i, enter[i][lane], leave[i][lane]);
    for (std::size_t i = 0; i < second_count_; ++i) {
      const Second& s = seconds_[i];
      if (s.lane == lane) events.add(s.literal, s.enter, s.leave);
    }
    return tree.event_crossings(item, events, visit);
  }

  /// Kinds that cost little more than their bounds: for few literals those tests don't pay.
  static bool is_cheap(PrimitiveKind kind) {
    return kind == PrimitiveKind::kCylinder || kind == PrimitiveKind::kEllipsoid ||
           kind == PrimitiveKind::kParallelepiped;
  }
  static constexpr std::size_t kFewLiterals = 4;

  /// The rays that may meet each literal's bounds. Only used if `has_near_`; else all rays may.
  std::array<Mask, crossings::kMaxFlatLiterals> near_;
  bool has_near_ = false;
  std::size_t second_count_ = 0;
  std::array<Second, crossings::kMaxFlatLiterals * kMaxLanes> seconds_;

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

/// The packet's rays, one by one, prepared for the items' tests.
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

/// Calls take(group's first ray, lanes) for each group of lanes with rays that can be solved
/// together for the item, and single(ray) for each other ray.
template <typename Take, typename Single>
HWY_INLINE void in_groups(const SurfaceItem& item, const CullingPacket& p, Mask rays, Take&& take,
                          Single&& single) {
  const std::size_t lanes = hn::Lanes(Lanes());
  const Mask alone = item.is_small ? rays & p.odd : rays;
  for (const std::size_t i : SetBits(alone)) single(i);
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
