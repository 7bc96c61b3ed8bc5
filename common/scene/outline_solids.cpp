#include "scene/outline_solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "csg/cylinder.hpp"

namespace graycube {
namespace {

/// The least power of two that no coordinate exceeds.
double unit_of(const OutlineLoops& loops) {
  double largest = 0;
  for (const OutlineLoop& loop : loops) {
    for (const OutlinePoint& p : loop)
      largest = std::max(largest, std::max(std::fabs(p.x), std::fabs(p.y)));
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  // The largest power of two will do for the largest numbers, which are beyond a scene's anyhow.
  const int most = std::numeric_limits<double>::max_exponent - 1;
  return largest > 0 ? std::ldexp(1.0, std::min(exponent, most)) : 1.0;
}

OutlineLoops divided(OutlineLoops loops, double unit) {
  for (OutlineLoop& loop : loops) {
    for (OutlinePoint& p : loop) p = {p.x / unit + 0.0, p.y / unit + 0.0};
  }
  return loops;
}

/// The frame of an outline in the scene's coordinates.
Affine frame(double across, double along, double base) {
  return {{{{across, 0, 0, 0}, {0, across, 0, 0}, {0, 0, along, base}}}};
}

/// All NaN for a map without an inverse, which why_unsound() then finds.
Affine inverse_or_nan(const Affine& map) {
  if (const auto inverse = map.inverse()) return *inverse;
  Affine none;
  for (auto& row : none.m) row.fill(std::numeric_limits<double>::quiet_NaN());
  return none;
}

/// Calls visit(box) for boxes around parts of the pieces that cover all of them.
template <typename Visit>
void each_part(const OutlinePiece& piece, int halvings, Visit& visit) {
  if (halvings == 0) return visit(piece.box());
  const auto x = piece.x.split(0.5);
  const auto y = piece.y.split(0.5);
  each_part({x.first, y.first}, halvings - 1, visit);
  each_part({x.second, y.second}, halvings - 1, visit);
}
template <typename Visit>
void each_part(const Outline& outline, Visit&& visit) {
  constexpr int kHalvings = 3;
  for (const OutlinePiece& piece : outline.pieces()) each_part(piece, kHalvings, visit);
}

Primitive primitive_of(PrimitiveKind kind, const Affine& to_world, const Affine& local,
                       std::uint32_t outline) {
  Primitive p;
  p.kind = kind;
  p.outline = outline;
  p.to_local = inverse_or_nan(compose(to_world, local));
  p.bounds = Aabb::nothing();
  return p;
}

/// Caps at local z = 0 and z = 1, as planes of the world through the ends as the scene gives them.
void set_ends(Primitive& p, const Vec3& world_base, const Vec3& world_top) {
  const Vec3 row = p.to_local.row(2);
  const double l = length(row);
  const Vec3 normal = l > 0 && std::isfinite(l)
                          ? normalized(row) + Vec3{}
                          : std::numeric_limits<double>::quiet_NaN() * Vec3{1, 1, 1};
  csg::set_caps(p, normal, dot(normal, world_base), dot(normal, world_top));
}

}  // namespace

const StockedOutline& OutlineStock::of(const OutlineLoops& loops) {
  const auto [known, is_new] = known_.try_emplace(&loops);
  if (is_new) {
    const double unit = unit_of(loops);
    known->second = {static_cast<std::uint32_t>(outlines_.size()), Outline(divided(loops, unit)),
                     unit};
    outlines_.push_back(known->second.outline);
  }
  return known->second;
}

Primitive build_lathe(const Affine& to_world, const StockedOutline& stocked) {
  const Affine local = frame(stocked.unit, stocked.unit, 0), map = compose(to_world, local);
  Primitive p = primitive_of(PrimitiveKind::kLathe, to_world, local, stocked.index);
  Vec3 disc;
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = map.row(i);
    disc[i] = std::sqrt(row.x * row.x + row.y * row.y);
  }
  each_part(stocked.outline, [&](const OutlineBox& box) {
    for (const double z : {box.lo.y, box.hi.y}) {
      const Vec3 center = map.point({0, 0, z}), extent = box.hi.x * disc;
      p.bounds = union_of(p.bounds, {center - extent, center + extent});
    }
  });
  return p;
}

Primitive build_sweep(const Affine& to_world, const StockedOutline& stocked, double base,
                      double height) {
  const Affine local = frame(stocked.unit, height, base), map = compose(to_world, local);
  Primitive p = primitive_of(PrimitiveKind::kSweep, to_world, local, stocked.index);
  set_ends(p, to_world.point({0, 0, base}), to_world.point({0, 0, base + height}));
  each_part(stocked.outline, [&](const OutlineBox& box) {
    for (int i = 0; i < 8; ++i)
      p.bounds.include(map.point(Aabb{{box.lo.x, box.lo.y, 0}, {box.hi.x, box.hi.y, 1}}.corner(i)));
  });
  return p;
}

}  // namespace graycube
