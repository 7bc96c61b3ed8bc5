// The part of space that one process renders: all of it (serial, roth), or macro-regions of the
// grid.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "crossings/ray_packet.hpp"
#include "crossings/surface_tree.hpp"
#include "csg/model.hpp"
#include "regions/camera.hpp"
#include "regions/macro_grid.hpp"
#include "subdivisions/crossing_search.hpp"
#include "trace/ray_task.hpp"
#include "visibility/foreign_bounds.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// A model and its subdivision.
struct Territory {
  std::shared_ptr<const Model> model;
  SubdivisionChoice subdivision;
  /// Only with the subdivision kSurfaces.
  std::optional<SurfaceTree> tree;
  /// With all others.
  std::unique_ptr<const CrossingSearch> search;

  /// The subdivision points at the model.
  static std::shared_ptr<const Territory> of(std::shared_ptr<const Model> model,
                                             const SubdivisionChoice& subdivision = {});
  static std::shared_ptr<const Territory> of(Model model,
                                             const SubdivisionChoice& subdivision = {}) {
    return of(std::make_shared<const Model>(std::move(model)), subdivision);
  }
  /// Bytes of the model and of its subdivision.
  std::size_t memory_bytes() const;
};

/// The scratch memory with which one evaluator looks for crossings.
struct CrossingScratch {
  TreeScratch tree;
  Mailbox mailbox;
  /// One for each place of Domain::borrowed_: what a scratch remembers belongs to one tree.
  std::vector<TreeScratch> borrowed;
  TreeScratch foreign;

  WalkCounts counts() const {
    WalkCounts sum = tree.counts;
    sum.add(mailbox.counts);
    for (const TreeScratch& b : borrowed) sum.add(b.counts);
    sum.add(foreign.counts);
    return sum;
  }
};

/// Immutable once built; shared by all evaluator threads of a process.
class Domain {
 public:
  /// All of space, without boundaries.
  explicit Domain(Model model, const SubdivisionChoice& subdivision = {})
      : Domain(std::make_shared<const Model>(std::move(model)), subdivision) {}
  explicit Domain(std::shared_ptr<const Model> model, const SubdivisionChoice& subdivision = {})
      : Domain(Territory::of(std::move(model), subdivision)) {}
  explicit Domain(std::shared_ptr<const Territory> territory);
  /// A node's macro-regions; the model is restricted to them. One model for all of them: a
  /// primitive that reaches into several is held once.
  Domain(MacroGrid grid, RegionShare share, Model model, const SubdivisionChoice& subdivision = {});

  const RenderSettings& settings() const { return territory_->model->settings; }
  const CameraFrame& frame() const { return frame_; }
  const Model& model() const { return *territory_->model; }
  const SubdivisionChoice& subdivision() const { return territory_->subdivision; }
  /// The number of leaf regions; of items, where a surface tree stands for them.
  std::size_t cell_count() const;
  /// Bytes of models and subdivisions, borrowed ones included.
  std::size_t memory_bytes() const;

  /// Sets the lights' horizons, at which shadow rays end.
  void set_horizons(std::shared_ptr<const LightHorizons> horizons) {
    horizons_ = std::move(horizons);
  }
  /// Sets the horizons of the objects that this domain does not hold; shadow rays need not leave it
  /// when none of these objects can stand in their way.
  void set_foreign_horizons(std::shared_ptr<const LightHorizons> horizons) {
    foreign_horizons_ = std::move(horizons);
  }
  /// Sets boxes around what this domain does not hold; rays that meet none of them need not leave.
  void set_foreign_bounds(std::shared_ptr<const ForeignBounds> bounds) {
    foreign_bounds_ = std::move(bounds);
  }
  /// The model is a replica of the whole scene, not only what the domain's regions need: no ray
  /// stops at their boundaries.
  void set_replica() { is_replica_ = true; }
  bool is_replica() const { return is_replica_; }
  /// The same domain, holding also what another node holds: shadow rays may be finished there.
  std::shared_ptr<const Domain> with_borrowed(std::uint32_t column, std::uint32_t row,
                                              std::shared_ptr<const Territory> territory) const;
  /// A domain like this one of a neighbour's regions, without foreign horizons and bounds as yet.
  std::shared_ptr<Domain> of_neighbour(const RegionShare& share, Model model) const;
  /// A domain with the same model, whose regions are those of a share of `grid`.
  Domain restricted_to(const MacroGrid& grid, const RegionShare& share) const {
    Domain domain = *this;
    domain.grid_ = grid;
    domain.share_ = share;
    return domain;
  }
  /// The same domain in a generation of the grid, where boundaries slide: rays that begin here
  /// belong to it.
  Domain of_generation(std::uint32_t generation) const {
    Domain domain = *this;
    domain.generation_ = generation % kMostGenerations;
    return domain;
  }
  /// RayTask::generation of the rays that begin here.
  std::uint16_t generation() const { return generation_; }
  const std::shared_ptr<const Territory>& territory() const { return territory_; }
  /// From now on the domain's regions are those of `share`; not to be called while rays are traced.
  void confine_to(const RegionShare& share) { share_ = share; }
  bool has_foreign_horizons() const { return foreign_horizons_ != nullptr; }
  /// Whether a shadow ray from `origin` that has `left` of its way to go is surely nearer to its
  /// light than `distance` (both in scene units).
  static bool is_beyond(const Vec3& origin, double left, double distance) {
    // Far larger than the rounding error of a ray's distance from its light.
    constexpr double kMargin = 1e-8;
    return left * (1 + kMargin) + kMargin * larger(1.0, max_abs(origin)) < distance;
  }
  /// Whether the domain holds all that a shadow ray can meet from `t`, in one of its regions, on;
  /// has_foreign_horizons() only.
  bool holds_way_to_light(const RayTask& task, double t) const {
    const Vec3 to_light = settings().lights[task.light].position - task.ray.origin;
    return is_beyond(task.ray.origin, length(to_light) - t,
                     foreign_horizons_->distance(task.light, -task.ray.direction));
  }
  bool has_foreign_bounds() const { return foreign_bounds_ != nullptr; }
  /// Bit i: the domain may lack something that ray i of the packet meets at t0 ≤ t ≤ t1;
  /// has_foreign_bounds() only.
  RayPacket::Mask may_meet_foreign(const RayPacket& packet, CrossingScratch& scratch) const {
    return foreign_bounds_->may_meet(packet, scratch.foreign);
  }
  bool borrows() const { return !borrowed_.empty(); }
  bool has_horizons() const { return horizons_ != nullptr; }
  /// has_horizons(), has_foreign_horizons() only.
  const LightHorizons& horizons() const { return *horizons_; }
  const LightHorizons& foreign_horizons() const { return *foreign_horizons_; }

  /// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins.
  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         CrossingScratch& scratch) const {
    if (territory_->tree) return territory_->tree->first_crossing(ray, t0, t1, scratch.tree);
    return territory_->search->first_crossing(ray, t0, t1, scratch.mailbox);
  }
  /// Lets light through the surfaces crossed in [t0, t1): multiplies it by each transparent one's
  /// transmit, in order of t, then of the objects. False when an opaque one ends it.
  bool pass_light(const Ray& ray, double t0, double t1, CrossingScratch& scratch,
                  Rgb& light) const {
    if (territory_->tree) return territory_->tree->pass_light(ray, t0, t1, scratch.tree, light);
    return territory_->search->pass_light(ray, t0, t1, scratch.mailbox, light);
  }
  /// Like pass_light(), for a region of this or another node; nothing when the region is neither
  /// held nor borrowed.
  std::optional<bool> pass_light_borrowed(RegionIndex region, const Ray& ray, double t0, double t1,
                                          CrossingScratch& scratch, Rgb& light) const;
  /// Like first_crossing(), for each ray of a packet: bit i of the result tells whether found[i]
  /// holds a crossing.
  RayPacket::Mask first_crossings(const RayPacket& packet, CrossingScratch& scratch,
                                  std::span<Crossing, RayPacket::kSize> found) const;
  /// Like pass_light(), for each ray of a packet: bit i of the result tells if light[i] arrives.
  RayPacket::Mask pass_lights(const RayPacket& packet, CrossingScratch& scratch,
                              std::span<Rgb, RayPacket::kSize> light) const;
  /// The grid of macro-regions; null when space has no boundaries.
  const MacroGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
  bool holds(RegionIndex region) const { return !grid_ || share_.owns(region); }
  /// The point where a ray leaves its region; nothing when no boundary stops it.
  std::optional<RegionExit> exit(const RayTask& task) const {
    if (!grid_ || is_replica_) return std::nullopt;
    return grid_->exit(task.region, task.ray, task.t);
  }
  /// Like exit(), for rays in one region: bit i of the result tells that ray i leaves it before
  /// t1[i]; then t1[i] is shortened to the exit, and exits[i] is set.
  RayPacket::Mask shorten_to_exits(RegionIndex region, RayPacket& packet,
                                   std::span<RegionExit, RayPacket::kSize> exits) const {
    if (!grid_ || is_replica_) return 0;
    return grid_->shorten_to_exits(region, packet, exits);
  }
  /// The macro-region in which a ray is at `t`, task.t or later.
  RegionIndex region_at(const RayTask& task, double t) const;
  /// Primary rays stay in their pixel's macro-region, unless they are on its boundary.
  bool primary_rays_may_leave() const {
    const auto is_inside = [](double at) { return at > 0 && at < 1; };
    return !is_inside(frame_.sample_x) || !is_inside(frame_.sample_y);
  }
  RegionIndex region_of_pixel(std::uint32_t x, std::uint32_t y) const {
    return grid_ ? grid_->region_of_pixel(x, y) : RegionIndex{};
  }

 private:
  CameraFrame frame_;
  std::optional<MacroGrid> grid_;
  RegionShare share_;
  std::shared_ptr<const Territory> territory_;
  bool is_replica_ = false;
  std::uint16_t generation_ = 0;
  /// Indexed by the owner's row · share_.columns + column; empty when nothing is borrowed.
  std::vector<std::shared_ptr<const Territory>> borrowed_;
  std::shared_ptr<const LightHorizons> horizons_, foreign_horizons_;
  std::shared_ptr<const ForeignBounds> foreign_bounds_;
};

}  // namespace graycube
