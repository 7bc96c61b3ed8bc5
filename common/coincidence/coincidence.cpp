#include "coincidence/coincidence.hpp"

#include "check.hpp"
#include "coincidence/plane_unifier.hpp"
#include "coincidence/surface_unifier.hpp"

namespace graycube {

bool unify_coincident_surfaces(Model& model, std::span<const Exactness> exactness) {
  GRAYCUBE_CHECK(exactness.size() == model.primitives.size(), "%zu of %zu", exactness.size(),
                 model.primitives.size());
  const auto count = static_cast<std::uint32_t>(model.primitives.size());
  if (count < 2) return false;
  csg::PlaneUnifier planes(model, exactness);
  csg::SurfaceUnifier surfaces(model, exactness);
  double reach = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    planes.count(i);
    surfaces.count(i);
    const Aabb& bounds = model.primitives[i].bounds;
    const double own = larger(max_abs(bounds.lo), max_abs(bounds.hi));
    if (own > reach && bounds.is_finite()) reach = own;
  }
  planes.begin_marking(reach);
  surfaces.begin_marking();
  for (std::uint32_t i = 0; i < count; ++i) {
    planes.mark(i);
    surfaces.mark(i);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    planes.collect(i);
    surfaces.collect(i);
  }
  const bool has_moved_planes = planes.unify();
  return surfaces.unify() || has_moved_planes;
}

}  // namespace graycube
