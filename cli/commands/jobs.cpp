// graycube jobs: the newest jobs of a farm, oldest first.
#include <algorithm>
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/job_text.hpp"
#include "cli/farm/client.hpp"

namespace graycube {

ExitStatus run(const JobsCommand& command) {
  FarmClient farm(command.connect);
  auto jobs = farm.ask<control::Jobs>(control::List{}, "jobs").first.jobs;
  std::sort(jobs.begin(), jobs.end(), [](const auto& a, const auto& b) { return a.job < b.job; });
  std::fputs(jobs_text(jobs).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
