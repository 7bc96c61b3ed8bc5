// Lathes and sweeps as primitives, and the outlines that they share.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "csg/primitive.hpp"
#include "outline/outline.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// One of a model's outlines. Its coordinates are those of the scene over `unit`, a power of two,
/// so that none is beyond 1.
struct StockedOutline {
  std::uint32_t index = 0;
  Outline outline;
  double unit = 1;
};

/// Appends outlines to those of a model, each once, however often refs and repeats use it.
class OutlineStock {
 public:
  explicit OutlineStock(std::vector<Outline>& outlines) : outlines_(outlines) {}
  /// `loops`, of the scene, must stay where they are.
  const StockedOutline& of(const OutlineLoops& loops);

 private:
  std::vector<Outline>& outlines_;
  std::map<const OutlineLoops*, StockedOutline> known_;
};

/// These take the map from the shape's coordinates to the world; `material` is left 0.
Primitive build_lathe(const Affine& to_world, const StockedOutline& stocked);
Primitive build_sweep(const Affine& to_world, const StockedOutline& stocked, double base,
                      double height);

}  // namespace graycube
