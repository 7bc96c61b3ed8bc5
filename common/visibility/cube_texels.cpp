#include "visibility/cube_texels.hpp"

#include "geometry/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/cube_texels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Computes cube_texel(cube_place(−direction)) in every lane.
void OppositeTexels(const double* x, const double* y, const double* z, std::size_t count,
                    std::uint32_t side, std::uint32_t* texels) {
  const hn::CappedTag<double, kTexelLanes> lanes;
  const hn::Rebind<std::int32_t, decltype(lanes)> whole;
  using V = hn::Vec<decltype(lanes)>;
  const V zero = hn::Zero(lanes), half = hn::Set(lanes, 0.5), one = hn::Set(lanes, 1.0);
  const V cells = hn::Set(lanes, static_cast<double>(side)),
          last = hn::Set(lanes, static_cast<double>(side - 1));
  const V all = hn::Set(lanes, 6.0 * side * side);
  for (std::size_t i = 0; i < count; i += hn::Lanes(lanes)) {
    const V dx = hn::Neg(hn::LoadU(lanes, x + i)), dy = hn::Neg(hn::LoadU(lanes, y + i)),
            dz = hn::Neg(hn::LoadU(lanes, z + i));
    const V ax = hn::Abs(dx), ay = hn::Abs(dy), az = hn::Abs(dz);
    const auto is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const auto is_y = hn::Ge(ay, az);  // where it isn't x
    const auto select = [&](V of_x, V of_y, V of_z) {
      return hn::IfThenElse(is_x, of_x, hn::IfThenElse(is_y, of_y, of_z));
    };
    const V main = select(dx, dy, dz);
    const V scale = hn::Div(half, hn::Abs(main));
    const auto cell = [&](V coordinate) {
      const V at = hn::Floor(hn::Mul(hn::Add(hn::Mul(coordinate, scale), half), cells));
      return hn::Min(hn::Max(at, zero), last);
    };
    const V u = cell(select(dy, dz, dx)), v = cell(select(dz, dx, dy));
    const V face = hn::Add(select(zero, hn::Add(one, one), hn::Set(lanes, 4.0)),
                           hn::IfThenElseZero(hn::Lt(main, zero), one));
    const V texel = hn::Add(hn::Mul(hn::Add(hn::Mul(face, cells), v), cells), u);
    const V safe = hn::IfThenElseZero(hn::And(hn::Ge(texel, zero), hn::Lt(texel, all)), texel);
    hn::StoreU(hn::BitCast(hn::RebindToUnsigned<decltype(whole)>(), hn::DemoteTo(whole, safe)),
               hn::RebindToUnsigned<decltype(whole)>(), texels + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(OppositeTexels);

void find_opposite_texels(std::span<const double> x, std::span<const double> y,
                          std::span<const double> z, std::size_t count, std::uint32_t side,
                          std::span<std::uint32_t> texels) {
  GRAYCUBE_SIMD_CALL(OppositeTexels)(x.data(), y.data(), z.data(), count, side, texels.data());
}

}  // namespace graycube
#endif
