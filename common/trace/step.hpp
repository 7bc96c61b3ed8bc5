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
  /// What came back for each ray that went in, or pixel of a rectangle: mostly one, more where it would hold
  /// too many contributions.
  std::vector<PixelReturn> returns;
  RayCounts rays;
  RoundingCounts rounding;

  void clear();
};

/// Evaluates rays until nothing of them is left in the domain: packet by packet of rays of one kind and
/// generation, the youngest first, so that what is under way stays little. One evaluator a thread.
class Evaluator {
 public:
  explicit Evaluator(const Domain& domain);

  /// Traces the primary rays of a rectangle of pixels; appends to `step`.
  void trace_pixels(const PixelRect& rect, Step& step);
  /// Traces rays that arrived from elsewhere (or primary rays); appends to `step`.
  void trace_rays(std::span<const RayTask> rays, Step& step);

  WalkCounts walk_counts() const { return scratch_.counts(); }

 private:
  /// A ray, and which of the open pixels it belongs to.
  struct OpenRay {
    RayTask task;
    std::uint32_t slot = 0;
  };

  /// What is known of a surface where a ray meets it.
  struct SurfacePoint {
    const Material& material;
    Vec3 p;
    /// The unit normal turned against the ray, and the ray's mirror direction.
    Vec3 n, mirror;
    bool entering;
  };

  void trace_block(const PixelRect& block, Step& step);
  void trace_all(Step& step);
  void start_primary_rays(const PixelRect& pixels, std::uint32_t sample, Step& step);
  void take_wave(std::vector<OpenRay>& stack);
  template <typename Trace>
  static void in_packets(std::span<const OpenRay> rays, Trace&& trace);
  void trace_sent_rays(Step& step);
  void trace_viewing_rays(std::span<const OpenRay> rays, Step& step);
  void trace_light_rays(std::span<const OpenRay> rays, Step& step);
  void go_on(const OpenRay& ray, const RegionExit& exit, std::vector<OpenRay>& stack, Step& step);
  void shade(const OpenRay& ray, const Crossing& hit, Step& step);
  void send_secondary_rays(const OpenRay& ray, const SurfacePoint& at, Step& step);
  void send_light_rays(const OpenRay& ray, const SurfacePoint& at, Step& step);
  void share_credit(const OpenRay& ray);
  void open_pixel(std::uint32_t pixel);
  void contribute(const OpenRay& ray, const Rgb& light, Step& step);
  void close_pixels(Step& step);

  const Domain& domain_;
  CrossingScratch scratch_;
  /// Rays of one kind, generation and region, under way together.
  std::vector<OpenRay> wave_;
  std::vector<OpenRay> viewing_, lights_;
  /// What the surfaces of one wave send out: refracted and reflected rays, and the shadow rays of each light.
  std::array<std::vector<OpenRay>, 2> secondary_;
  std::vector<std::vector<OpenRay>> shadow_;
  /// The lights, and kinds of secondary rays, that the surface being shaded sends rays for.
  std::vector<std::uint32_t> lit_by_, sends_;
  /// By slot.
  std::vector<PixelReturn> open_;
};

}  // namespace graycube
