// graycube cancel: stops a job that waits or is running.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/client.hpp"

namespace graycube {

ExitStatus run(const CancelCommand& command) {
  FarmClient farm(command.connect);
  farm.ask<control::JobInfo>(control::Cancel{command.job}, "cancel");
  std::printf("job %u is cancelled\n", command.job);
  return ExitStatus::kDone;
}

}  // namespace graycube
