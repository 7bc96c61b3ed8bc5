// The pure step: rays go in; rays that go on and light come out. No sockets, threads, clocks or
// picture. `serial`, `roth` and `macro` are three ways to feed it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "coordination/credit.hpp"
#include "film/fixed_point.hpp"
#include "shading/light_beam.hpp"
#include "shading/media.hpp"
#include "shading/surface_view.hpp"
#include "trace/domain.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// Light for one pixel, and the credit that comes back with it; or AOVs of a pixel (aov_slot).
struct PixelReturn {
  std::uint32_t pixel = 0;
  /// The number of contributions merged here; at most kMaxMergedContributions.
  std::uint32_t merged = 0;
  FixedRgb light;
  Credit credit;
};

/// Rays by kind, each counted where it is created (and so once).
struct RayCounts {
  std::array<std::uint64_t, kRayKinds> created{};
  /// Shadow rays that ended at their light's horizon.
  std::uint64_t skipped_by_horizon = 0;

  void add(const RayCounts& o) {
    for (std::size_t i = 0; i < created.size(); ++i) created[i] += o.created[i];
    skipped_by_horizon += o.skipped_by_horizon;
  }
};

struct Step {
  /// Rays that left the domain, each with the region it goes on in and the t reached.
  std::vector<RayTask> leaving;
  /// A shadow ray, as it left the domain's own regions, that waits for the model of `region`.
  struct Lacking {
    RayTask task;
    RegionIndex region;
  };
  std::vector<Lacking> lacking;
  /// Rays in the domain that are still to be traced (see Evaluator::stop_after).
  std::vector<RayTask> set_aside;
  /// What came back for each ray that went in, or for each pixel of a rectangle: mostly one entry,
  /// more when one entry would hold too many contributions.
  std::vector<PixelReturn> returns;
  RayCounts rays;
  RoundingCounts rounding;

  void clear();
};

/// Evaluates rays until none of them, nor of their descendants, is left in the domain. It takes
/// packets of rays of one kind and generation, the youngest first, so that few rays are pending at
/// a time. Each thread has its own evaluator.
class Evaluator {
 public:
  /// Rays are traced in waves of at most this many: those of an 8 × 8 block of pixels.
  static constexpr std::uint32_t kBlockSide = 8;
  static constexpr std::size_t kWaveRays = kBlockSide * kBlockSide;

  explicit Evaluator(const Domain& domain);

  /// Once this many rays of a step have left the domain or wait for a model, all other pending rays
  /// are set aside. This is checked between waves of at most kWaveRays rays, each of which may send
  /// out one ray to each light and two others.
  void stop_after(std::size_t most_leaving) { most_leaving_ = most_leaving; }

  /// Traces the primary rays of a rectangle of pixels; appends to `step`.
  void trace_pixels(const PixelRect& rect, Step& step);
  /// Traces rays that arrived from elsewhere (or primary rays); appends to `step`.
  void trace_rays(std::span<const RayTask> rays, Step& step);

  WalkCounts walk_counts() const { return scratch_.counts(); }

 private:
  /// A pending ray, and the index in open_ of the pixel that it belongs to.
  struct OpenRay {
    RayTask task;
    std::uint32_t slot = 0;
    /// Index in surfaces_ of the surface that sent it; used until its credit is known.
    std::uint32_t surface = 0;
    /// For a shadow ray: the domain holds all objects that may stand in its way, in any region.
    bool stays = false;
  };

  /// The point where a ray of the wave meets a surface.
  struct SurfacePoint {
    const OpenRay* ray;
    const Material* material;
    /// The ray's mirror direction.
    Vec3 mirror;
    /// The ray's parameter, and whether it had left its macro-region by then.
    double t;
    bool is_beyond;
    /// Whether the solid is seen from within, and the media before and behind its surface.
    bool is_within;
    Medium before = 0, behind = 0;
    std::uint32_t lights = 0, secondary_rays = 0;
  };
  /// One number for each surface of a wave.
  using Coordinates = std::array<double, kWaveRays>;

  Rgb ambient_light(const Material& m, double cosine) const;
  Rgb background(const RayTask& task) const;
  SurfaceView view_of(const SurfacePoint& at, std::size_t surface) const;
  Rgb light_share(std::size_t surface, const Vec3& to_light) const;
  void trace_block(const PixelRect& block, Step& step);
  void finish_pixels(Step& step);
  void trace_all(Step& step);
  void start_primary_rays(const PixelRect& pixels, std::uint32_t sample, std::uint32_t& slot,
                          Step& step);
  bool has_enough(const Step& step) const;
  void set_all_aside(Step& step);
  void take_wave(std::vector<OpenRay>& stack);
  void trace_wave(Step& step);
  template <typename Trace>
  static void in_packets(std::span<OpenRay> rays, Trace&& trace);
  void trace_sent_rays(Step& step);
  void trace_viewing_rays(std::span<OpenRay> rays, Step& step);
  RayPacket::Mask shorten_to_exits(std::span<const OpenRay> rays, RayPacket& packet,
                                   std::span<RegionExit, RayPacket::kSize> exits) const;
  RayPacket::Mask must_leave(RayPacket::Mask leaving, const RayPacket& packet,
                             std::span<const RegionExit, RayPacket::kSize> exits,
                             RayPacket::Mask hits,
                             std::span<const Crossing, RayPacket::kSize> found);
  RayPacket::Mask shorten_light_rays(std::span<const OpenRay> rays, RayPacket& packet,
                                     std::span<RegionExit, RayPacket::kSize> exits);
  void trace_light_rays(std::span<const OpenRay> rays, Step& step);
  void go_on(const OpenRay& ray, const RegionExit& exit, Step& step);
  void go_on_to_light(const OpenRay& ray, const Rgb& light, const RegionExit& exit, Step& step);
  void finish_light_ray(const OpenRay& ray, Step& step);
  void light_arrives(const OpenRay& ray, const Rgb& light, Step& step);
  void shade(OpenRay& ray, const Crossing& hit, bool is_beyond, Step& step);
  void cross_media(RayTask& task, const Crossing& hit, SurfacePoint& at) const;
  RegionIndex region_of(const SurfacePoint& at) const;
  void send_secondary_ray(SurfacePoint& at, RayKind kind, const Vec3& direction, const Rgb& weight,
                          Step& step);
  void send_secondary_rays(SurfacePoint& at, const Vec3& n, Step& step);
  void send_light_rays(std::uint32_t light, Step& step);
  void send_light_ray(std::uint32_t light, std::size_t surface, Step& step);
  /// The fate of a new shadow ray at its light's horizon.
  enum class Horizon : std::uint8_t { kGoesOn, kArrives, kEndsInShadow };
  void look_up_horizons(std::uint32_t light);
  /// The stretch in which a shadow ray's crossings count: t ≤ their parameter < t_max.
  struct ShadowWay {
    double t, t_max;
    bool ends_at_horizon = false;
  };
  static Horizon meet_horizon(const LightHorizons::Reach& reach, ShadowWay& way);
  void share_credit();
  void open_pixel(std::uint32_t pixel);
  void contribute(const OpenRay& ray, const Rgb& light, Step& step);
  void close_pixels(Step& step);

  const Domain& domain_;
  /// Where each light shines.
  std::vector<LightBeam> beams_;
  std::size_t most_leaving_ = std::numeric_limits<std::size_t>::max();
  CrossingScratch scratch_;
  /// Rays of one kind, generation and region, under way together.
  std::vector<OpenRay> wave_;
  std::vector<OpenRay> viewing_, lights_;
  /// The surfaces of the wave, with their points and normals as arrays of coordinates, and for the
  /// current light their unit direction to it, distance from it and cosine to the normal.
  std::vector<SurfacePoint> surfaces_;
  /// For surfaces with a pattern: their materials with the colour that it has there.
  std::array<Material, kWaveRays> patterned_;
  alignas(64) std::array<Coordinates, 3> point_, normal_, to_light_;
  alignas(64) Coordinates distance_, cosine_;
  /// Distances from the current light (if the domain has horizons), for each surface of the wave:
  /// nearer to the light there is surely no surface at all, and no foreign surface.
  std::array<float, kWaveRays> lit_, all_held_;
  /// Rays that the wave's surfaces send out: [0] refracted, [1] reflected; shadow rays by light.
  std::array<std::vector<OpenRay>, 2> secondary_;
  std::vector<std::vector<OpenRay>> shadow_;
  /// The pixels whose sums are open, indexed by OpenRay::slot.
  std::vector<PixelReturn> open_;
};

}  // namespace graycube
