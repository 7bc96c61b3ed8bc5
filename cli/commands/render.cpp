// graycube render: writes a picture, and leaves nothing else behind.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/commands/commands.hpp"
#include "cli/display/json_text.hpp"
#include "cli/farm/frontal_process.hpp"
#include "cli/farm/host_plan.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/farm/loss_options.hpp"
#include "cli/interrupts.hpp"
#include "cli/option_sense.hpp"
#include "cli/render_here.hpp"
#include "process/clocks.hpp"
#include "proto/model_slice.hpp"
#include "proto/statistics.hpp"

namespace graycube {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<std::string> frontal_arguments(const RenderCommand& command, const HostPlan& plan,
                                           const std::unique_ptr<Checkpoint>& checkpoint) {
  std::vector<std::string> arguments{"--private", "--nodes", std::to_string(plan.nodes),
                                     "--threads", std::to_string(command.threads)};
  arguments.insert(arguments.end(), plan.arguments.begin(), plan.arguments.end());
  if (!plan.listen.empty()) arguments.insert(arguments.end(), {"--listen", plan.listen});
  for (const std::string& word : loss_arguments(command.losses)) arguments.push_back(word);
  if (checkpoint != nullptr) {
    arguments.insert(arguments.end(), {"--checkpoint", checkpoint->file().string(), "--picture",
                                       std::to_string(checkpoint->picture().content)});
  }
  return arguments;
}

/// Of the checkpoint that a job of Slurm gets by itself, beside its picture.
constexpr const char* kCheckpointEnding = ".checkpoint";

/// Where the nodes run; serial has none.
HostPlan plan_for(const RenderCommand& command) {
  const bool is_serial = command.options.algorithm == Algorithm::kSerial;
  return plan_hosts(is_serial ? FarmKind::kLocal : command.farm, command.nodes, "");
}

/// Refuses a file that can't be a checkpoint, before anything is rendered.
std::unique_ptr<Checkpoint> checkpoint_of(const RenderCommand& command, const Outputs& outputs,
                                          const SceneInput& scene) {
  if (command.checkpoint.empty()) return nullptr;
  check_output("--checkpoint", command.checkpoint, command.scene);
  for (const auto* file : {&outputs.exr, &outputs.png, &outputs.stats}) {
    if (!file->empty() && std::filesystem::absolute(*file).lexically_normal() ==
                              std::filesystem::absolute(command.checkpoint).lexically_normal())
      throw usage_failure("--checkpoint " + command.checkpoint.string(),
                          "is written to as another file, too");
  }
  return std::make_unique<Checkpoint>(command.checkpoint, picture_of(scene, command.options));
}

/// A compiled scene may be at most so many times as long as its text, which holds a shape only once
/// however often it is used.
constexpr std::size_t kMostExpansion = 4;

/// The bytes that go to the farm: the scene compiled, which saves the frontal from reading it
/// again, or its text.
SharedBytes bytes_to_send(SceneInput scene) {
  const Model model = compile_input(scene);
  scene.scene = {};
  const std::size_t most = std::min(kMaxSubmitBytes, kMostExpansion * scene.text.size());
  if (fits_model_limits(model) && encoded_model_bytes(model) <= most) return encode_model(model);
  return bytes_of(scene.text);
}

ImageSize size_of(const Scene& scene, const control::JobOptions& options) {
  ImageSize size = scene.settings.image;
  size.width = options.width.value_or(size.width);
  size.height = options.height.value_or(size.height);
  return size;
}

/// Renders on a farm of its own, which also writes the pictures if it can: then there are no pixels
/// here. Interrupts must be held, as the farm has to be put away.
Rendered render_on_farm(const RenderCommand& command, const Outputs& outputs,
                        const std::string& name, SharedBytes scene, const ImageSize& size,
                        FrontalProcess& frontal) {
  ProgressDisplay display(stdout, command.is_quiet, command.as_json);
  const std::string& endpoint = frontal.wait_until_listening();
  bool ends_on_interrupt = true;
  FarmClient farm({endpoint, frontal.key_file()}, [&] {
    if (ends_on_interrupt) throw_if_interrupted();
    frontal.check_running();
  });
  control::JobOptions options = command.options;
  options.timeout_s = 0;  // the command's own clock runs since before the farm's start
  const std::uint32_t job = submit_scene(farm, name, std::move(scene), options);
  Rendered rendered;
  rendered.stats = follow_job(farm, job, display);
  // From here on, as when the command writes the files, an interrupt changes nothing any more.
  throw_if_interrupted();
  ends_on_interrupt = false;
  if (const auto written = have_picture_written(farm, job, outputs, size)) {
    rendered.picture.width = written->width;
    rendered.picture.height = written->height;
    rendered.written_cpu_s = written->cpu_s;
  } else {
    ends_on_interrupt = true;
    rendered.picture = fetch_picture(farm, job);
  }
  rendered.summary = summary_text(job_info(farm, job));
  return rendered;
}

/// Writes statistics with the time of the whole command, which it returns, with the part that
/// reading took, and with the CPU time in which the frontal wrote pictures.
double write_timed_stats(const Outputs& outputs, const std::string& stats,
                         Clock::time_point started, double load_s, double written_cpu_s = 0) {
  const double wall_s = seconds_since(started);
  write_stats(outputs,
              with_command_times(stats, wall_s, process_cpu_seconds() + written_cpu_s, load_s));
  return wall_s;
}

void write_outputs(const RenderCommand& command, const Outputs& outputs, const std::string& scene,
                   const Rendered& rendered, Clock::time_point started, double load_s) {
  if (!rendered.picture.rgb.empty()) write_pictures(outputs, rendered.picture, scene);
  const double wall_s =
      write_timed_stats(outputs, rendered.stats, started, load_s, rendered.written_cpu_s);
  if (command.is_quiet) return;
  if (command.as_json) {
    std::printf("{\"exr\":%s,\"width\":%u,\"height\":%u,\"wall_s\":%.3f}\n",
                json_string(outputs.exr.string()).c_str(), rendered.picture.width,
                rendered.picture.height, wall_s);
  } else {
    std::printf("%s: %u x %u, %s, %s\n", outputs.exr.c_str(), rendered.picture.width,
                rendered.picture.height, rendered.summary.c_str(), duration_text(wall_s).c_str());
  }
  // The files are what counts: a reader of this output that has gone is no failure.
  std::fflush(stdout);
  std::clearerr(stdout);
}

void render_serially(const RenderCommand& command, const Outputs& outputs, SceneInput scene,
                     Checkpoint* checkpoint, Clock::time_point started, double load_s) {
  std::optional<InterruptsHeld> held;
  if (checkpoint != nullptr) held.emplace();
  const std::string name = scene.name;
  ProgressDisplay display(stdout, command.is_quiet, command.as_json);
  Rendered rendered;
  try {
    rendered = render_here(std::move(scene), command.options, command.threads, display, checkpoint);
  } catch (const Failure&) {
    display.clear();
    if (checkpoint != nullptr) checkpoint->print_hint();
    throw;
  }
  if (!held) held.emplace();
  write_outputs(command, outputs, name, rendered, started, load_s);
  if (checkpoint != nullptr) checkpoint->remove();
}

}  // namespace

ExitStatus run(const RenderCommand& asked) {
  const auto started = Clock::now();
  RenderCommand command = asked;
  catch_interrupts("render", command.options.timeout_s);
  check_sense(command.options);
  Outputs outputs = command.outputs;
  if (outputs.exr.empty()) outputs.exr = default_exr(command.scene);
  const HostPlan plan = plan_for(command);
  // A job that is ended before its time may be queued again, and then goes on where it was.
  if (plan.kind == FarmKind::kSlurm && command.checkpoint.empty())
    command.checkpoint = outputs.exr.string() + kCheckpointEnding;
  check_outputs(outputs, command.scene);
  const auto reading = Clock::now();
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  double load_s = seconds_since(reading);
  const std::string name = scene.name;
  if (!command.is_quiet) {
    for (const Problem& warning : scene.warnings) print(warning);
  }
  const auto checkpoint = checkpoint_of(command, outputs, scene);
  if (command.options.algorithm == Algorithm::kSerial) {
    render_serially(command, outputs, std::move(scene), checkpoint.get(), started, load_s);
    return ExitStatus::kDone;
  }
  const auto preparing = Clock::now();
  prepare_for_farm(scene, command.options);
  load_s += seconds_since(preparing);
  const InterruptsHeld held;
  FrontalProcess frontal(frontal_arguments(command, plan, checkpoint));
  Rendered rendered;
  try {
    const auto compiling = Clock::now();
    const ImageSize size = size_of(scene.scene, command.options);
    SharedBytes bytes = bytes_to_send(std::move(scene));
    load_s += seconds_since(compiling);
    rendered = render_on_farm(command, outputs, name, std::move(bytes), size, frontal);
  } catch (const Failure& failure) {
    write_timed_stats(outputs, failure.statistics(), started, load_s);
    if (checkpoint != nullptr) {
      frontal.stop();  // it records what is whole
      checkpoint->print_hint();
    }
    throw;
  }
  // The files are written while the farm stops; from here on an interrupt changes nothing any more.
  frontal.request_stop();
  write_outputs(command, outputs, name, rendered, started, load_s);
  frontal.stop();
  if (checkpoint != nullptr) checkpoint->remove();
  return ExitStatus::kDone;
}

}  // namespace graycube
