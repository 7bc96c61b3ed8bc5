// graycube submit: sends a scene to a running farm.
#include <poll.h>
#include <signal.h>

#include <chrono>
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/interrupts.hpp"
#include "cli/option_sense.hpp"

namespace graycube {
namespace {

/// How long a second Ctrl-C is waited for.
constexpr std::chrono::seconds kSecondCtrlC{2};

void check_sense(const SubmitCommand& command) {
  if (command.options.algorithm == Algorithm::kSerial) {
    throw usage_failure("--algorithm serial", "needs no farm; use 'graycube render'");
  }
  if (!command.waits && !command.outputs.none()) {
    throw usage_failure("submit",
                        "without --wait there is nothing to write yet; get the picture "
                        "with 'graycube fetch JOB -o OUT.exr'");
  }
  graycube::check_sense(command.options);
  check_outputs(command.outputs, command.scene);
}

void check_farm_size(FarmClient& farm, std::uint32_t expected) {
  const auto nodes = farm.ask<control::NodeList>(control::Nodes{}, "farm").first.nodes.size();
  if (nodes == expected) return;
  throw usage_failure("-n " + std::to_string(expected),
                      "the farm has " + std::to_string(nodes) + (nodes == 1 ? " node" : " nodes"));
}

/// Ctrl-C while a job is waited for: says that the job goes on. Another one soon after cancels it.
/// Returns the failure with which the command then ends.
Failure interrupted(const SubmitCommand& command, std::uint32_t job) {
  const std::string number = std::to_string(job);
  const std::string goes_on =
      "job " + number + " goes on; 'graycube cancel " + number + "' stops it";
  if (noted_interrupt() != SIGINT)
    return {ExitStatus::kFailed, Problem{"submit", "interrupted", goes_on}};
  print({"submit", "SIGINT",
         goes_on + ", and so does Ctrl-C within " + std::to_string(kSecondCtrlC.count()) + " s"});
  forget_interrupt();
  const auto until = std::chrono::steady_clock::now() + kSecondCtrlC;
  while (!is_interrupted() && std::chrono::steady_clock::now() < until) {
    pollfd wait{wakeup_descriptor(), POLLIN, 0};
    ::poll(&wait, 1, 100);
    clear_wakeup();
  }
  const bool cancels = is_interrupted();
  forget_interrupt();
  if (cancels) FarmClient(command.connect).ask<control::JobInfo>(control::Cancel{job}, "cancel");
  note_interrupt(SIGINT);
  if (!cancels) return {ExitStatus::kFailed, std::vector<Problem>{}};
  return {ExitStatus::kFailed, Problem{"submit", "SIGINT", "job " + number + " is cancelled"}};
}

/// Waits for the job's end and writes what is wanted of it.
void wait_for_job(const SubmitCommand& command, const std::string& scene, FarmClient& farm,
                  std::uint32_t job) {
  const InterruptsHeld held;
  ProgressDisplay display(command.as_json ? stdout : stderr, command.is_quiet, command.as_json);
  std::string stats;
  Picture picture;
  try {
    stats = follow_job(farm, job, display);
    display.clear();
    if (!command.outputs.exr.empty() || !command.outputs.png.empty())
      picture = fetch_picture(farm, job);
  } catch (const Failure& failure) {
    display.clear();
    if (is_interrupted()) throw interrupted(command, job);
    write_stats(command.outputs, failure.statistics());
    throw;
  }
  if (picture.height > 0) write_pictures(command.outputs, picture, scene);
  write_stats(command.outputs, stats);
  if (picture.height == 0 || command.is_quiet || command.as_json) return;
  const auto& file = command.outputs.exr.empty() ? command.outputs.png : command.outputs.exr;
  std::fprintf(stderr, "%s: %u x %u, %s\n", file.c_str(), picture.width, picture.height,
               summary_text(job_info(farm, job)).c_str());
}

}  // namespace

ExitStatus run(const SubmitCommand& command) {
  catch_interrupts("submit", 0);
  check_sense(command);
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  for (const Problem& warning : scene.warnings) print(warning);
  prepare_for_farm(scene, command.options);
  FarmClient farm(command.connect, [] { throw_if_interrupted(); });
  if (command.nodes != 0) check_farm_size(farm, command.nodes);
  const std::uint32_t job = submit_scene(farm, scene, command.options);
  std::printf(command.as_json ? "{\"job\":%u}\n" : "%u\n", job);
  std::fflush(stdout);
  if (command.waits) wait_for_job(command, scene.name, farm, job);
  return ExitStatus::kDone;
}

}  // namespace graycube
