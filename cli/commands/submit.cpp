// graycube submit: sends a scene to a running farm.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/interrupts.hpp"

namespace graycube {
namespace {

void check_sense(const SubmitCommand& command) {
  if (command.options.algorithm == Algorithm::kSerial) {
    throw usage_failure("--algorithm serial", "needs no farm; use 'graycube render'");
  }
  if (!command.waits && !command.outputs.none()) {
    throw usage_failure("submit",
                        "without --wait there is nothing to write yet; get the picture "
                        "with 'graycube fetch JOB -o OUT.exr'");
  }
  check_outputs(command.outputs, command.scene);
}

void check_farm_size(FarmClient& farm, std::uint32_t expected) {
  const auto nodes = farm.ask<control::NodeList>(control::Nodes{}, "farm").first.nodes.size();
  if (nodes == expected) return;
  throw usage_failure("-n " + std::to_string(expected),
                      "the farm has " + std::to_string(nodes) + (nodes == 1 ? " node" : " nodes"));
}

}  // namespace

ExitStatus run(const SubmitCommand& command) {
  catch_interrupts("submit", 0);
  check_sense(command);
  SceneInput scene = read_scene_input(command.scene, command.options, command.choice);
  check_is_built(command.scene, scene.scene);
  for (const Problem& warning : scene.warnings) print(warning);
  prepare_for_farm(scene, command.options);
  FarmClient farm(command.connect);
  if (command.nodes != 0) check_farm_size(farm, command.nodes);
  const std::uint32_t job = submit_scene(farm, scene, command.options);
  std::printf("%u\n", job);
  std::fflush(stdout);
  if (!command.waits) return ExitStatus::kDone;
  ProgressDisplay display(stderr, command.is_quiet);
  std::string stats;
  try {
    stats = follow_job(farm, job, display);
  } catch (const Failure& failure) {
    write_stats(command.outputs, failure.statistics());
    throw;
  }
  display.clear();
  Picture picture;
  if (!command.outputs.exr.empty() || !command.outputs.png.empty()) {
    picture = fetch_picture(farm, job);
  }
  const InterruptsHeld held;
  if (picture.height > 0) write_pictures(command.outputs, picture, scene.name);
  write_stats(command.outputs, stats);
  return ExitStatus::kDone;
}

}  // namespace graycube
