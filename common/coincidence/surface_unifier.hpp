// Gives curved surfaces that are the same the same numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coincidence/clusters.hpp"
#include "coincidence/exactness.hpp"
#include "coincidence/sightings.hpp"
#include "coincidence/surface_numbers.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// Like PlaneUnifier, measures each surface when it is added, and looks at few of them again.
class SurfaceUnifier {
 public:
  /// `exactness` has an element for each primitive of the model by the time that it is added.
  SurfaceUnifier(Model& model, const std::vector<Exactness>& exactness)
      : model_(model), exactness_(exactness) {}

  void reserve(std::size_t primitives) { sightings_.reserve(primitives); }
  /// Adds a primitive, each once. Simplifies a cone whose ends are equal to a cylinder, an elliptic
  /// torus that is round to a torus, and a quadric that is a cylinder to a standard form.
  void add(std::uint32_t primitive);
  /// Gives surfaces that are one the same numbers; returns whether any surface has changed.
  bool unify();

 private:
  bool is_better(std::uint32_t a, std::uint32_t b) const;
  void unify_cluster(std::span<const Extent> cluster);

  Model& model_;
  const std::vector<Exactness>& exactness_;
  Sightings sightings_;
  bool has_changed_ = false;
  std::array<std::vector<Extent>, kSurfaceFamilies> families_;
};

}  // namespace graycube::csg
