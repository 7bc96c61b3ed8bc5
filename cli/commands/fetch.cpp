// graycube fetch: a done job's picture and statistics.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/interrupts.hpp"

namespace graycube {

ExitStatus run(const FetchCommand& command) {
  catch_interrupts("fetch", 0);
  check_outputs(command.outputs, {});
  FarmClient farm(command.connect);
  const control::JobInfo info = job_info(farm, command.job);
  const Picture picture = fetch_picture(farm, command.job);
  std::string stats;
  if (!command.outputs.stats.empty()) {
    ProgressDisplay none(stdout, true);
    stats = follow_job(farm, command.job, none);  // a done job's statistics come at once
  }
  const InterruptsHeld held;
  write_pictures(command.outputs, picture, info.scene);
  write_stats(command.outputs, stats);
  std::printf("%s: %u x %u, %s\n", command.outputs.exr.c_str(), picture.width, picture.height,
              summary_text(info).c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube
