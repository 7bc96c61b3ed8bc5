// The part of space that one process renders: all of it (serial, roth), or macro-regions of the grid.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "csg/model.hpp"
#include "space/bsp.hpp"
#include "space/camera.hpp"
#include "space/macro_grid.hpp"
#include "space/ray_packet.hpp"
#include "space/surface_tree.hpp"
#include "space/walk.hpp"

namespace graycube {

/// How a process finds crossings. Both give the same, bit for bit.
enum class Subdivision : std::uint8_t {
  kSurfaceTree,  ///< a bounding volume hierarchy over the surfaces: the fast one
  kLinkedCells,  ///< the report's: a BSP whose leaf regions are linked to their neighbours
};

/// One macro-region and what is in it.
struct Territory {
  Model model;
  std::optional<SurfaceTree> tree;
  std::optional<Bsp> bsp;
};

/// What one evaluator needs to look for crossings.
struct CrossingScratch {
  TreeScratch tree;
  Mailbox mailbox;

  WalkCounts counts() const {
    WalkCounts sum = tree.counts;
    sum.add(mailbox.counts);
    return sum;
  }
};

/// Immutable once built; shared by all evaluator threads of a process.
class Domain {
 public:
  /// All of space, without boundaries.
  explicit Domain(Model model, Subdivision subdivision = Subdivision::kSurfaceTree);
  /// One macro-region; the model is restricted to it.
  Domain(MacroGrid grid, RegionIndex region, Model model,
         Subdivision subdivision = Subdivision::kSurfaceTree);

  const RenderSettings& settings() const { return territory_->model.settings; }
  const CameraFrame& frame() const { return frame_; }
  const Model& model() const { return territory_->model; }
  /// Leaf regions, or cells of objects.
  std::size_t cell_count() const;
  /// Bytes of the subdivision.
  std::size_t memory_bytes() const;

  /// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins.
  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         CrossingScratch& scratch) const {
    if (territory_->tree) return territory_->tree->first_crossing(ray, t0, t1, scratch.tree);
    scratch.mailbox.begin_ray();
    return graycube::first_crossing(*territory_->bsp, ray, t0, t1, scratch.mailbox);
  }
  /// Lets light through the surfaces crossed in [t0, t1): multiplies it by each transparent one's transmit,
  /// in order of t, then of the objects. False when an opaque one ends it.
  bool pass_light(const Ray& ray, double t0, double t1, CrossingScratch& scratch, Rgb& light) const {
    if (territory_->tree) return territory_->tree->pass_light(ray, t0, t1, scratch.tree, light);
    scratch.mailbox.begin_ray();
    return graycube::pass_light(*territory_->bsp, ray, t0, t1, scratch.mailbox, light);
  }
  /// As first_crossing for each ray of a packet: bit i of the result tells whether found[i] holds a crossing.
  RayPacket::Mask first_crossings(const RayPacket& packet, CrossingScratch& scratch,
                                  std::span<Crossing, RayPacket::kSize> found) const;
  /// As pass_light for each ray of a packet: bit i of the result tells whether light[i] arrives.
  RayPacket::Mask pass_lights(const RayPacket& packet, CrossingScratch& scratch,
                              std::span<Rgb, RayPacket::kSize> light) const;
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
