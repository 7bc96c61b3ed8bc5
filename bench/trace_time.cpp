// trace_time SCENE [--size N] [--threads T] [--exr OUT.exr] [--build-only]
// [--subdivision WAY [--entry descent|extremal]]: where a serial render's time and memory go.
// Prints one JSON object; times are CPU seconds of all threads together.
#include <cstdio>

#include "bench/clocks.hpp"
#include "bench/scene_arguments.hpp"
#include "film/picture_files.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

namespace graycube::bench {
namespace {

unsigned long long created(const SerialResult& r, RayKind kind) {
  return r.rays.created[static_cast<std::size_t>(kind)];
}

void print_trace(const SerialResult& r) {
  unsigned long long all = 0;
  for (const std::uint64_t n : r.rays.created) all += n;
  const double rays = all > 0 ? static_cast<double>(all) : 1;
  std::printf(
      ", \"trace_cpu_s\": %.6f, \"rays\": {\"primary\": %llu, \"shadow\": %llu, "
      "\"reflection\": %llu, \"refraction\": %llu}, \"skipped_by_horizon\": %llu",
      r.busy_s, created(r, RayKind::kPrimary), created(r, RayKind::kShadow),
      created(r, RayKind::kReflection), created(r, RayKind::kRefraction),
      static_cast<unsigned long long>(r.rays.skipped_by_horizon));
  const auto per_ray = [&](const char* name, std::uint64_t WalkCounts::*count) {
    std::printf(", \"%s_per_ray\": %.4f", name, static_cast<double>(r.walk.*count) / rays);
  };
  per_ray("cells", &WalkCounts::cells_visited);
  per_ray("primitives", &WalkCounts::primitives_tested);
  per_ray("quartics", &WalkCounts::quartics_solved);
  per_ray("saved", &WalkCounts::tests_saved);
  per_ray("boxes", &WalkCounts::boxes_tested);
  per_ray("boxes_rejected", &WalkCounts::boxes_rejected);
  per_ray("spheres", &WalkCounts::spheres_tested);
  per_ray("spheres_rejected", &WalkCounts::spheres_rejected);
  per_ray("nodes", &WalkCounts::nodes_descended);
  per_ray("entry_links", &WalkCounts::entry_links);
  std::printf(", \"not_shot\": %llu", static_cast<unsigned long long>(r.walk.rays_not_shot));
}

void run(const SceneArguments& arguments) {
  const std::uint64_t heap_before = heap_bytes();
  CpuClock clock;
  Model model = compile_scene(load(arguments));
  const double load_s = clock.lap();
  const std::size_t primitives = model.primitives.size();
  const Domain domain(std::move(model), arguments.subdivision);
  const double build_s = clock.lap();
  const std::uint64_t held = heap_bytes() - heap_before;
  std::printf(
      "{\"primitives\": %zu, \"load_s\": %.6f, \"build_s\": %.6f, \"held_bytes\": %llu, "
      "\"bytes_per_primitive\": %.1f, \"cells\": %zu",
      primitives, load_s, build_s, static_cast<unsigned long long>(held),
      static_cast<double>(held) / static_cast<double>(primitives > 0 ? primitives : 1),
      domain.cell_count());
  if (!arguments.build_only) {
    const ImageSize& image = domain.settings().image;
    Film film(image.width, image.height, image.samples * image.samples);
    print_trace(render_serial(domain, {.threads = arguments.threads, .progress = {}}, film));
    if (arguments.exr) write_exr(*arguments.exr, film.develop(), {});
  }
  std::printf(", \"peak_rss_bytes\": %llu}\n",
              static_cast<unsigned long long>(peak_resident_bytes()));
}

}  // namespace
}  // namespace graycube::bench

int main(int argc, char** argv) {
  return graycube::bench::run_with_scene("trace_time", argc, argv, graycube::bench::run);
}
