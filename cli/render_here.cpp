#include "cli/render_here.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "cli/interrupts.hpp"
#include "process/clocks.hpp"
#include "proto/job_settings.hpp"
#include "proto/messages/search_report.hpp"
#include "proto/statistics.hpp"
#include "trace/render_serial.hpp"
#include "version.hpp"

namespace graycube {
namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t peak_resident_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

control::Progress progress_at(double share, Clock::time_point started) {
  control::Progress p;
  p.state = JobState::kRendering;
  p.fraction = share;
  if (share > 0) p.eta_s = seconds_since(started) * (1 - share) / share;
  return p;
}

std::uint64_t created(const RayCounts& rays, RayKind kind) {
  return rays.created[static_cast<std::size_t>(kind)];
}

/// The only node of a serial render. In the time that its threads did not trace, they waited for
/// the last one.
control::NodeStats node_stats(const SerialResult& r, double threads, double render_s) {
  control::NodeStats n;
  n.pid = static_cast<std::uint64_t>(::getpid());
  n.cpu_s = process_cpu_seconds();
  n.busy_s = r.busy_s;
  n.idle_s = std::max(0.0, threads * render_s - r.busy_s);
  n.peak_rss_bytes = peak_resident_bytes();
  n.primary = created(r.rays, RayKind::kPrimary);
  n.shadow = created(r.rays, RayKind::kShadow);
  n.reflection = created(r.rays, RayKind::kReflection);
  n.refraction = created(r.rays, RayKind::kRefraction);
  n.skipped_by_horizon = r.rays.skipped_by_horizon;
  n.non_finite = r.rounding.non_finite;
  n.clamped = r.rounding.clamped;
  report_search(r.walk, n);
  return n;
}

/// Takes up what is recorded, and has tiles recorded that become whole.
void use(Checkpoint& checkpoint, Film& film, SerialOptions& how) {
  checkpoint.restore(film);
  how.is_wanted = [&checkpoint](const PixelRect& tile) { return checkpoint.is_wanted(tile); };
  how.tile_done = [&checkpoint](const PixelRect& tile) { checkpoint.note(tile); };
}

}  // namespace

Rendered render_here(SceneInput scene, const control::JobOptions& options, std::uint32_t threads,
                     ProgressDisplay& display, Checkpoint* checkpoint) {
  Statistics s;
  s.version = kVersion;
  s.scene = scene.name;
  s.algorithm = Algorithm::kSerial;
  s.threads = threads;
  s.subdivision = options.subdivision;

  const auto loading = Clock::now();
  apply_overrides(options, scene.scene.settings);
  Model model = compile_input(scene);
  scene = {};
  s.image = model.settings.image;
  s.primitives = model.primitives.size();
  s.objects = model.objects.size();
  s.load_s = seconds_since(loading);

  const auto building = Clock::now();
  const Domain domain(std::move(model), options.subdivision);
  s.build_s = seconds_since(building);

  const auto rendering = Clock::now();
  Film film(s.image.width, s.image.height, s.image.samples * s.image.samples,
            domain.settings().aovs);
  SerialOptions how;
  how.threads = threads;
  how.progress = [&](double share) {
    display.show(progress_at(share, rendering));
    if (checkpoint == nullptr) return true;
    checkpoint->write(film, false);
    return !is_interrupted();
  };
  if (checkpoint != nullptr) use(*checkpoint, film, how);
  const SerialResult result = render_serial(domain, how, film);
  if (checkpoint != nullptr) s.resumed_tiles = checkpoint->resumed();
  if (!result.finished) {
    checkpoint->write(film, true);
    throw_if_interrupted();
  }
  s.render_s = seconds_since(rendering);
  s.per_node.push_back(node_stats(result, threads, s.render_s));
  s.per_node.front().primitives = s.primitives;
  s.per_node.front().memory_bytes = domain.memory_bytes();
  s.per_node.front().cells = domain.cell_count();
  display.clear();
  return {film.develop(), statistics_json(s),
          "serial, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads"), 0};
}

}  // namespace graycube
