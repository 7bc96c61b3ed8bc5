// graycube status: how one job is getting on, or the farm.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/farm_text.hpp"
#include "cli/display/job_text.hpp"
#include "cli/display/json_text.hpp"
#include "cli/farm/job_client.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

bool has_ended(JobState state) {
  return state == JobState::kDone || state == JobState::kFailed || state == JobState::kCancelled;
}

/// A job as JSON; of one that hasn't ended also, as "waits_for", what its message says it waits
/// for.
std::string json_of(const control::JobInfo& info) {
  constexpr std::string_view before = "waits for ";
  std::string json = encode(info);
  if (info.message.starts_with(before) && !has_ended(info.state)) {
    json.pop_back();
    json += ",\"waits_for\":" + json_string(info.message.substr(before.size())) + "}";
  }
  return json + "\n";
}

}  // namespace

ExitStatus run(const StatusCommand& command) {
  if (command.is_of_farm == (command.number != 0)) {
    throw usage_failure("status", "expected either a job's id or --farm");
  }
  FarmClient farm(command.connect);
  if (command.is_of_farm) {
    const auto info = farm.ask<control::FarmInfo>(control::Farm{}, "farm").first;
    std::fputs(command.as_json ? farm_json(info).c_str() : farm_text(info).c_str(), stdout);
    return ExitStatus::kDone;
  }
  const control::JobInfo info = job_info(farm, command.number);
  std::fputs(command.as_json ? json_of(info).c_str() : job_text(info).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
