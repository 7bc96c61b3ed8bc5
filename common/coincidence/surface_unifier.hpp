// Gives curved surfaces that are the same the same numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "coincidence/candidates.hpp"
#include "coincidence/exactness.hpp"
#include "coincidence/surface_numbers.hpp"
#include "csg/model.hpp"

namespace graycube::csg {

/// To be shown all primitives three times, as PlaneUnifier.
class SurfaceUnifier {
 public:
  SurfaceUnifier(Model& model, std::span<const Exactness> exactness)
      : model_(model), exactness_(exactness) {}

  /// Makes a cone whose ends are equal, an elliptic torus that is round, and a quadric that is a
  /// cylinder what they are.
  void count(std::uint32_t primitive);
  void begin_marking();
  void mark(std::uint32_t primitive);
  void collect(std::uint32_t primitive);
  /// Changes the surfaces of what was collected; whether any surface differs now.
  bool unify();

 private:
  bool is_better(std::uint32_t a, std::uint32_t b) const;
  void unify_cluster(std::span<const Extent> cluster);

  Model& model_;
  std::span<const Exactness> exactness_;
  std::size_t count_ = 0;
  bool has_changed_ = false;
  /// The sum of how far surfaces may be off.
  double distances_ = 0;
  std::optional<Candidates> candidates_;
  std::array<std::vector<Extent>, kSurfaceFamilies> families_;
};

}  // namespace graycube::csg
