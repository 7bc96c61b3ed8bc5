// graycube jobs: the newest jobs of a farm, oldest first.
#include <cstdio>

#include "cli/commands.hpp"
#include "cli/farm_client.hpp"
#include "cli/job_text.hpp"

namespace graycube {

ExitStatus run(const JobsCommand& command) {
  FarmClient farm(command.connect);
  const auto [jobs, payload] = farm.ask<control::Jobs>(control::List{}, "jobs");
  std::fputs(jobs_text(jobs.jobs).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
