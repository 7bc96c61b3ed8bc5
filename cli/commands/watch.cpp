// graycube watch: a job's progress, until it ends.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/farm/job_client.hpp"
#include "cli/interrupts.hpp"
#include "proto/control.hpp"

namespace graycube {

ExitStatus run(const WatchCommand& command) {
  catch_interrupts("watch", 0);
  FarmClient farm(command.connect);
  job_info(farm, command.job);  // is there a farm, and such a job?
  {
    ProgressDisplay display(stdout, false, command.as_json);
    follow_job(farm, command.job, display);
  }
  const control::JobInfo info = job_info(farm, command.job);
  if (command.as_json) {
    std::fputs((encode(info) + "\n").c_str(), stdout);
    return ExitStatus::kDone;
  }
  std::printf("%s: %s, %s\n", std::string(to_string(info.state)).c_str(), info.scene.c_str(),
              summary_text(info).c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube
