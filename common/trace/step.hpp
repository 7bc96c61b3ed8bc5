// The pure step: rays go in; rays that go on and light come out. No sockets, threads, clocks or picture.
// `serial`, `roth` and `macro` are three ways to feed it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coordination/credit.hpp"
#include "film/fixed_point.hpp"
#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Light for one pixel, and the credit that comes back with it; or a pixel's AOVs (aov_slot).
struct PixelReturn {
  std::uint32_t pixel = 0;
  /// So many contributions were merged here; at most kMaxMergedContributions.
  std::uint32_t merged = 0;
  FixedRgb light;
  Credit credit;
};

/// Rays by kind, each counted where it is created (and so once).
struct RayCounts {
  std::array<std::uint64_t, kRayKinds> created{};
  /// Shadow rays answered by a light horizon, without a walk.
  std::uint64_t skipped_by_horizon = 0;

  void add(const RayCounts& o) {
    for (std::size_t i = 0; i < created.size(); ++i) created[i] += o.created[i];
    skipped_by_horizon += o.skipped_by_horizon;
  }
};

struct Step {
  /// Rays that left the domain, each with the region it goes on in and the t reached.
  std::vector<RayTask> leaving;
  /// Consecutive contributions to one pixel are merged.
  std::vector<PixelReturn> returns;
  RayCounts rays;
  RoundingCounts rounding;

  void clear();
};

/// Evaluates rays one after another until nothing of them is left in the domain. One evaluator a thread.
class Evaluator {
 public:
  explicit Evaluator(const Domain& domain) : domain_(domain) {}

  /// Traces the primary rays of a rectangle of pixels; appends to `step`.
  void trace_pixels(const PixelRect& rect, Step& step);
  /// Traces rays that arrived from elsewhere (or primary rays); appends to `step`.
  void trace_rays(std::span<const RayTask> rays, Step& step);

  WalkCounts walk_counts() const { return scratch_.counts(); }

 private:
  void trace_tree(const RayTask& root, Step& step);
  void trace_light_ray(RayTask& task, Step& step);
  void trace_viewing_ray(RayTask& task, Step& step);
  void shade(const RayTask& task, double t, std::uint32_t primitive, bool entering, Step& step);
  void contribute(const RayTask& task, const Rgb& light, const Credit& credit, Step& step);
  void give_back(std::uint32_t pixel, const Credit& credit, Step& step);

  const Domain& domain_;
  CrossingScratch scratch_;
  std::vector<RayTask> stack_;
};

}  // namespace graycube
