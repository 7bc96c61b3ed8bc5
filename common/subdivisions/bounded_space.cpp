#include "subdivisions/bounded_space.hpp"

namespace graycube {
namespace {

/// Planes keep off the finite primitives by this many times the model's delta, so that none of
/// these touches the space around.
constexpr double kMargin = 4;

Aabb cube_around(const Aabb& box) {
  const Vec3 center = box.center();
  const double half = 0.5 * max_abs(box.hi - box.lo);
  return union_of(box, {center - Vec3{half, half, half}, center + Vec3{half, half, half}});
}

}  // namespace

BoundedSpace::BoundedSpace(const Model& model, bool as_cube, CellContent& inside)
    : programs_(model) {
  const CellContent all = content_of(model);
  const Aabb extent = finite_extent(all, model);
  box_ = extent.is_empty() ? extent : extent.grown(kMargin * model.delta);
  if (as_cube && !box_.is_empty()) box_ = cube_around(box_);
  around_ = programs_.add(all.restricted([&](std::uint32_t primitive) {
    return model.primitives[primitive].bounds.is_finite() ? CellSide::kOutside : CellSide::kCrosses;
  }));
  if (!box_.is_empty()) inside = restricted_to(all, model, box_);
}

}  // namespace graycube
