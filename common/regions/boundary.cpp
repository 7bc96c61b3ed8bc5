#include "regions/boundary.hpp"

#include "geometry/infinity.hpp"
#include "geometry/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "regions/boundary.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void Passages(std::span<const RegionSide* const> sides, const Vec3& eye, const RayPacket& packet,
              FirstPassages& first) {
  const hn::CappedTag<double, RayPacket::kSize> lanes;
  using V = hn::Vec<decltype(lanes)>;
  // In the order of Vec3's dot, without fused multiplication.
  const auto dot_with = [&](const Vec3& n, V x, V y, V z) {
    return hn::Add(hn::Add(hn::Mul(hn::Set(lanes, n.x), x), hn::Mul(hn::Set(lanes, n.y), y)),
                   hn::Mul(hn::Set(lanes, n.z), z));
  };
  const V inf = hn::Set(lanes, kInf);
  const V zero = hn::Zero(lanes);
  for (std::size_t i = 0; i < packet.count; i += hn::Lanes(lanes)) {
    const auto origin = [&](std::size_t a) {
      return hn::Sub(hn::Load(lanes, packet.origin[a].data() + i),
                     hn::Set(lanes, eye[static_cast<int>(a)]));
    };
    const auto direction = [&](std::size_t a) {
      return hn::Load(lanes, packet.direction[a].data() + i);
    };
    const V ox = origin(0), oy = origin(1), oz = origin(2);
    const V dx = direction(0), dy = direction(1), dz = direction(2);
    const V t0 = hn::Load(lanes, packet.t0.data() + i);
    V t = inf, side = zero;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const BoundaryPlane& plane = sides[s]->plane;
      const bool far = sides[s]->far;
      const V b = dot_with(plane.normal, dx, dy, dz);
      const V a = hn::Sub(dot_with(plane.normal, ox, oy, oz), hn::Set(lanes, plane.offset));
      const auto is_parallel = hn::Le(hn::Abs(b), hn::Set(lanes, plane.flat));
      const auto goes_out = far ? hn::Lt(b, zero) : hn::Not(hn::Lt(b, zero));
      const auto is_in = far ? hn::Ge(a, zero) : hn::Not(hn::Ge(a, zero));
      V at = hn::IfThenElse(goes_out, hn::Div(hn::Neg(a), b), inf);
      at = hn::IfThenElse(is_parallel, hn::IfThenElse(is_in, inf, hn::Neg(inf)), at);
      at = hn::IfThenElse(hn::Lt(at, t0), t0, at);
      const auto is_nearer = hn::Lt(at, t);
      t = hn::IfThenElse(is_nearer, at, t);
      side = hn::IfThenElse(is_nearer, hn::Set(lanes, static_cast<double>(s)), side);
    }
    hn::Store(t, lanes, first.t.data() + i);
    hn::Store(side, lanes, first.side.data() + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(Passages);

void find_first_passages(std::span<const RegionSide* const> sides, const Vec3& eye,
                         const RayPacket& packet, FirstPassages& first) {
  GRAYCUBE_SIMD_CALL(Passages)(sides, eye, packet, first);
}

}  // namespace graycube
#endif
