// graycube cancel: stops a job that waits or is running.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/job_client.hpp"

namespace graycube {

ExitStatus run(const CancelCommand& command) {
  FarmClient farm(command.connect);
  try {
    farm.ask<control::JobInfo>(control::Cancel{command.job}, "cancel");
  } catch (const Failure&) {
    // The frontal may have cancelled it, and died before it said so.
    if (!farm.has_asked_again() || job_info(farm, command.job).state != JobState::kCancelled) throw;
  }
  std::printf("job %u is cancelled\n", command.job);
  return ExitStatus::kDone;
}

}  // namespace graycube
