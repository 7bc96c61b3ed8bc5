// The part of space that one process renders: all of it (serial, roth), or macro-regions of the grid.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "csg/model.hpp"
#include "space/bsp.hpp"
#include "space/camera.hpp"
#include "space/macro_grid.hpp"

namespace graycube {

/// One macro-region and what is in it.
struct Territory {
  Model model;
  Bsp bsp;
};

/// Immutable once built; shared by all evaluator threads of a process.
class Domain {
 public:
  /// All of space, without boundaries.
  explicit Domain(Model model);
  /// One macro-region; the model is restricted to it.
  Domain(MacroGrid grid, RegionIndex region, Model model);

  const RenderSettings& settings() const { return territory_->model.settings; }
  const CameraFrame& frame() const { return frame_; }
  const Model& model() const { return territory_->model; }
  const Bsp& bsp() const { return territory_->bsp; }
  /// The grid of macro-regions; null when space has no boundaries.
  const MacroGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  bool holds(RegionIndex region) const { return !grid_ || region == region_; }
  /// Where a ray leaves the region that it is in; nothing when space has no boundaries.
  std::optional<RegionExit> exit(RegionIndex region, const Ray& ray, double t) const {
    if (!grid_) return std::nullopt;
    return grid_->exit(region, ray, t);
  }
  RegionIndex region_of_pixel(std::uint32_t x, std::uint32_t y) const {
    return grid_ ? grid_->region_of_pixel(x, y) : RegionIndex{};
  }

 private:
  CameraFrame frame_;
  std::optional<MacroGrid> grid_;
  RegionIndex region_;
  /// On the heap: the BSP points at the model beside it.
  std::unique_ptr<Territory> territory_;
};

}  // namespace graycube
