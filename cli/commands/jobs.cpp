// graycube jobs: a farm's jobs, those first that are not over yet.
#include <algorithm>
#include <cstdio>
#include <tuple>

#include "cli/commands/commands.hpp"
#include "cli/display/job_text.hpp"
#include "cli/display/json_list.hpp"
#include "cli/farm/client.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

/// What runs, then what waits, then what has ended; the oldest first.
auto place_of(const control::JobInfo& job) {
  const bool has_ended = job.finished_s.has_value();
  return std::tuple(has_ended, job.state == JobState::kQueued, job.job);
}

}  // namespace

ExitStatus run(const JobsCommand& command) {
  FarmClient farm(command.connect);
  auto jobs = farm.ask<control::Jobs>(control::List{}, "jobs").first.jobs;
  std::sort(jobs.begin(), jobs.end(),
            [](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
  const std::size_t all = jobs.size();
  const std::size_t first = std::min<std::size_t>(command.skip, all);
  const std::size_t shown = std::min<std::size_t>(command.limit, all - first);
  const auto begin = jobs.begin() + static_cast<std::ptrdiff_t>(first);
  std::vector<control::JobInfo> page(begin, begin + static_cast<std::ptrdiff_t>(shown));
  if (command.as_json) {
    std::fputs((list_in(encode(control::Jobs{std::move(page)})) + "\n").c_str(), stdout);
    return ExitStatus::kDone;
  }
  std::fputs(jobs_text(page).c_str(), stdout);
  if (first + shown < all) {
    std::printf("jobs %zu to %zu of %zu; --skip %zu shows more\n", first + 1, first + shown, all,
                first + shown);
  }
  return ExitStatus::kDone;
}

}  // namespace graycube
