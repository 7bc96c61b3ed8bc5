#include "coincidence/coincidence.hpp"

#include <algorithm>

#include "check.hpp"

namespace graycube {

void CoincidenceUnifier::reserve(std::size_t primitives) {
  exactness_.reserve(primitives);
  planes_.reserve(primitives);
  surfaces_.reserve(primitives);
}

void CoincidenceUnifier::add(const Exactness& exactness) {
  const auto primitive = static_cast<std::uint32_t>(exactness_.size());
  GRAYCUBE_CHECK(primitive < model_.primitives.size(), "%u", primitive);
  exactness_.push_back(exactness);
  const Primitive& p = model_.primitives[primitive];
  const bool is_bounded = p.bounds.is_finite();
  if (is_bounded) {
    for (std::size_t a = 0; a < 3; ++a) worst_[a] = std::max(worst_[a], exactness.along[a]);
  }
  if (!is_bounded || p.kind == PrimitiveKind::kMesh) return late_.push_back(primitive);
  planes_.add(primitive);
  surfaces_.add(primitive);
}

bool CoincidenceUnifier::unify() {
  GRAYCUBE_CHECK(exactness_.size() == model_.primitives.size(), "%zu of %zu", exactness_.size(),
                 model_.primitives.size());
  for (const std::uint32_t i : late_) {
    // A half-space has no size by which to judge its offset, which may be the small difference of
    // larger numbers: the exactness of the bounded primitives stands in.
    constexpr float kPart = 1.0f / 8;
    if (!model_.primitives[i].bounds.is_finite()) {
      auto& along = exactness_[i].along;
      for (std::size_t a = 0; a < 3; ++a) along[a] = std::max(along[a], kPart * worst_[a]);
    }
    planes_.add(i);
    surfaces_.add(i);
  }
  if (exactness_.size() < 2) return false;
  const bool has_moved_planes = planes_.unify();
  return surfaces_.unify() || has_moved_planes;
}

bool unify_coincident_surfaces(Model& model, std::span<const Exactness> exactness) {
  GRAYCUBE_CHECK(exactness.size() == model.primitives.size(), "%zu of %zu", exactness.size(),
                 model.primitives.size());
  CoincidenceUnifier unifier(model);
  for (const Exactness& e : exactness) unifier.add(e);
  return unifier.unify();
}

}  // namespace graycube
