// graycube render: a picture, and nothing else left behind.
#include <chrono>
#include <cstdio>
#include <optional>

#include "cli/commands.hpp"
#include "cli/cpu_time.hpp"
#include "cli/frontal_process.hpp"
#include "cli/interrupts.hpp"
#include "cli/job_client.hpp"
#include "cli/render_here.hpp"
#include "proto/statistics.hpp"

namespace graycube {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> frontal_arguments(const RenderCommand& command) {
  return {"--private", "--nodes", std::to_string(command.nodes), "--threads",
          std::to_string(command.threads)};
}

/// Renders on a farm of its own. Interrupts must be held: the farm has to be put away.
Rendered render_on_farm(const RenderCommand& command, SceneInput scene, FrontalProcess& frontal) {
  ProgressDisplay display(stdout, command.is_quiet);
  const std::string& endpoint = frontal.wait_until_listening();
  FarmClient farm(endpoint, [&] {
    throw_if_interrupted();
    frontal.check_running();
  });
  control::JobOptions options = command.options;
  options.timeout_s = 0;  // the command's own clock runs since before the farm's start
  const std::uint32_t job = submit_scene(farm, scene, options);
  scene = {};
  Rendered rendered;
  rendered.stats = follow_job(farm, job, display);
  rendered.picture = fetch_picture(farm, job);
  rendered.summary = summary_text(job_info(farm, job));
  return rendered;
}

/// With what the whole command took, which it returns.
double write_timed_stats(const Outputs& outputs, const std::string& stats, Clock::time_point started) {
  const double wall_s = std::chrono::duration<double>(Clock::now() - started).count();
  write_stats(outputs, with_command_times(stats, wall_s, own_cpu_seconds()));
  return wall_s;
}

void write_outputs(const RenderCommand& command, const Outputs& outputs, const std::string& scene,
                   const Rendered& rendered, Clock::time_point started) {
  write_pictures(outputs, rendered.picture, scene);
  const double wall_s = write_timed_stats(outputs, rendered.stats, started);
  if (command.is_quiet) return;
  std::printf("%s: %u x %u, %s, %s\n", outputs.exr.c_str(), rendered.picture.width,
              rendered.picture.height, rendered.summary.c_str(), duration_text(wall_s).c_str());
  // The files are what counts; who no longer reads along may leave.
  std::fflush(stdout);
  std::clearerr(stdout);
}

}  // namespace

ExitStatus run(const RenderCommand& command) {
  const auto started = Clock::now();
  catch_interrupts("render", command.options.timeout_s);
  Outputs outputs = command.outputs;
  if (outputs.exr.empty()) outputs.exr = default_exr(command.scene);
  check_outputs(outputs, command.scene);
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  check_is_built(command.scene, scene.scene);
  const std::string name = scene.name;
  if (!command.is_quiet) {
    for (const Problem& warning : scene.warnings) print(warning);
  }
  if (command.options.algorithm == Algorithm::kSerial) {
    ProgressDisplay display(stdout, command.is_quiet);
    Rendered rendered = render_here(std::move(scene), command.options, command.threads, display);
    const InterruptsHeld held;
    write_outputs(command, outputs, name, rendered, started);
    return ExitStatus::kDone;
  }
  check_farm_limits(scene, command.options);
  const InterruptsHeld held;
  FrontalProcess frontal(frontal_arguments(command));
  scene.scene = {};
  Rendered rendered;
  try {
    rendered = render_on_farm(command, std::move(scene), frontal);
  } catch (const Failure& failure) {
    write_timed_stats(outputs, failure.statistics(), started);
    throw;
  }
  // The files are written while the farm stops; from here on an interrupt changes nothing any more.
  frontal.request_stop();
  write_outputs(command, outputs, name, rendered, started);
  frontal.stop();
  return ExitStatus::kDone;
}

}  // namespace graycube
