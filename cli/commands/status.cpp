// graycube status: how one job is getting on.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/job_text.hpp"
#include "cli/farm/job_client.hpp"
#include "proto/control.hpp"

namespace graycube {

ExitStatus run(const StatusCommand& command) {
  FarmClient farm(command.connect);
  const control::JobInfo info = job_info(farm, command.job);
  std::fputs(command.as_json ? (encode(info) + "\n").c_str() : job_text(info).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
