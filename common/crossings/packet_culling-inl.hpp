// A packet of rays in floats, as tests of boxes need it; and these tests, for all rays at once and
// for each ray.
#if defined(GRAYCUBE_SPACE_PACKET_CULLING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_PACKET_CULLING_INL
#undef GRAYCUBE_SPACE_PACKET_CULLING_INL
#else
#define GRAYCUBE_SPACE_PACKET_CULLING_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "crossings/ray_packet.hpp"
#include "crossings/tree_walk-inl.hpp"
#include "geometry/infinity.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Mask = RayPacket::Mask;
constexpr std::size_t kRays = RayPacket::kSize;
using FloatLanes = hn::CappedTag<float, 16>;

/// The packet in floats that are rounded so that box tests stay conservative.
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
      last[i] = -kFloatInf;
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
  /// Parameters at which the stretch of each ray that is still searched begins and ends.
  alignas(64) Floats first, last;
  alignas(64) std::array<std::array<double, kRays>, 3> inverse;
  /// Rays parallel to a coordinate plane: their items are looked up singly.
  Mask odd = 0;

  // Bounds over all rays.
  float first_of_all = 0, last_of_all = 0;
  std::array<float, 3> least_near_inverse, greatest_near_inverse, least_far_inverse,
      greatest_far_inverse, extreme_near_origin, extreme_far_origin;
  std::array<std::size_t, 3> near_side;
  /// The packet's rays go both ways along the axis, so it can't cull them all at once.
  std::array<bool, 3> is_mixed;

 private:
  /// A ray coordinate whose empty places repeat the first ray's.
  const DoublesOfAll& padded(const DoublesOfAll& v, std::size_t count) {
    if (count == kRays) return v;
    DoublesOfAll& copy = padding[next_padding++ % padding.size()];
    for (std::size_t i = 0; i < kRays; ++i) copy[i] = v[i < count ? i : 0];
    return copy;
  }

  /// Computes what CullingAxis does, for every ray, and the bounds of the results.
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
      const auto steep =
          hn::IfThenElse(hn::Lt(hn::Abs(given), flattest), hn::CopySign(flattest, given), given);
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
    // The origins that bring the near plane nearest, and the far plane farthest.
    const bool up = near_side[a] == 0;
    extreme_near_origin[a] = up ? near_origins.greatest() : near_origins.least();
    extreme_far_origin[a] = up ? far_origins.least() : far_origins.greatest();
  }

  /// Stores lanes, and keeps their least and greatest.
  struct Bounds {
    using V = hn::Vec<FloatLanes>;
    HWY_INLINE Bounds() : lo(hn::Set(FloatLanes(), kFloatInf)), hi(hn::Neg(lo)) {}
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

/// Bits of the boxes of a node that any ray may meet; near[i] is set to the earliest t for box i.
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

/// Those of `rays` that may meet a box, by the arithmetic of meet(). plane(side, axis) gives the
/// coordinates of the box's planes, the lower ones for side 0.
template <typename PlaneOf>
HWY_INLINE Mask meet_box(PlaneOf&& plane, const CullingPacket& p, Mask rays) {
  const FloatLanes d;
  const std::size_t lanes = hn::Lanes(d);
  Mask mask = 0;
  for (std::size_t i = 0; i < kRays; i += lanes) {
    if (((rays >> i) & ((Mask{1} << lanes) - 1)) == 0) continue;
    auto from = hn::Load(d, p.first.data() + i);
    auto to = hn::Load(d, p.last.data() + i);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto near_inverse = hn::Load(d, p.near_inverse[a].data() + i);
      auto near_plane = hn::Set(d, plane(p.near_side[a], a));
      auto far_plane = hn::Set(d, plane(1 - p.near_side[a], a));
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

/// Those of `rays` that may meet the box in place `slot` of a node.
HWY_INLINE Mask meet_each(const WideNode& node, std::size_t slot, const CullingPacket& p,
                          Mask rays) {
  return meet_box([&](std::size_t side, std::size_t a) { return node.planes[side][a][slot]; }, p,
                  rays);
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
