// What coincides in a model coincides to the bit: faces in one plane get the same plane, surfaces
// that are one sphere, ellipsoid, cylinder, cone, torus or quadric get the same numbers. Then a ray
// crosses them at equal parameters, and what is taken together at equal t (crossings/crossings.hpp)
// leaves no skin where a cut is flush with a face. A model's own surfaces become one where they lie
// within how exactly they are known; docs/design/coincidence.md says how near that is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coincidence/exactness.hpp"
#include "coincidence/plane_unifier.hpp"
#include "coincidence/surface_unifier.hpp"
#include "csg/model.hpp"

namespace graycube {

/// To be told of each primitive as soon as the model has it, while it lies in the processor's
/// cache.
class CoincidenceUnifier {
 public:
  explicit CoincidenceUnifier(Model& model)
      : model_(model), planes_(model, exactness_), surfaces_(model, exactness_) {}

  void reserve(std::size_t primitives);
  /// Tells how exactly the next primitive is known, which the model has by now; may simplify its
  /// kind.
  void add(const Exactness& exactness);
  /// Changes the model's primitives, planes and meshes, and the bounds of primitives, in place.
  /// Whether anything changed. Deterministic, and independent of the order of primitives; surfaces
  /// without a partner keep their bits. Object bounds, trees and delta are left alone: compute them
  /// afterwards.
  bool unify();

 private:
  Model& model_;
  std::vector<Exactness> exactness_;
  csg::PlaneUnifier planes_;
  csg::SurfaceUnifier surfaces_;
  /// The worst along each axis that anything bounded is known.
  std::array<float, 3> worst_{};
  /// Unbounded primitives and meshes, which are compared with all others.
  std::vector<std::uint32_t> late_;
};

/// The same for a model that is whole; `exactness` has one element for each primitive.
bool unify_coincident_surfaces(Model& model, std::span<const Exactness> exactness);

}  // namespace graycube
