// Makes surfaces that coincide in a model coincide to the bit: faces in one plane get the same
// plane, surfaces that are one sphere, ellipsoid, cylinder, cone, torus or quadric the same
// numbers. Then a ray crosses them at equal t, and since such crossings are taken together
// (crossings/crossings.hpp), no skin is left where a cut is flush with a face. Surfaces become one
// if they are as near as they are exactly known; docs/design/coincidence.md says how near that is.
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

/// Is told of each primitive as soon as the model has it, while it lies in the processor's
/// cache.
class CoincidenceUnifier {
 public:
  explicit CoincidenceUnifier(Model& model)
      : model_(model), planes_(model, exactness_), surfaces_(model, exactness_) {}

  void reserve(std::size_t primitives);
  /// Adds the next primitive of the model, which is known to `exactness`; may simplify its
  /// kind.
  void add(const Exactness& exactness);
  /// Changes the model's primitives, planes and meshes, and the bounds of primitives, in place;
  /// returns whether anything changed. Deterministic, and independent of the order of primitives;
  /// surfaces without a partner keep their bits. Object bounds, trees and delta are left alone:
  /// compute them afterwards.
  bool unify();

 private:
  Model& model_;
  std::vector<Exactness> exactness_;
  csg::PlaneUnifier planes_;
  csg::SurfaceUnifier surfaces_;
  /// The worst exactness along each axis of any bounded primitive.
  std::array<float, 3> worst_{};
  /// Unbounded primitives and meshes, which are compared with all others.
  std::vector<std::uint32_t> late_;
};

/// Unifies the surfaces of a finished model; `exactness` has one element for each primitive.
bool unify_coincident_surfaces(Model& model, std::span<const Exactness> exactness);

}  // namespace graycube
