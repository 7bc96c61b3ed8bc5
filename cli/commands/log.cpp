// graycube log: what a farm's log says, and what is added to it.
#include <algorithm>
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/farm_text.hpp"
#include "cli/farm/client.hpp"
#include "cli/interrupts.hpp"

namespace graycube {
namespace {

/// How long the frontal is asked to wait for a line.
constexpr double kLogWait_s = 10;

void print(const control::LogLine& line, bool as_json) {
  std::fputs(as_json ? log_json(line).c_str() : log_text(line).c_str(), stdout);
}

}  // namespace

ExitStatus run(const LogCommand& command) {
  catch_interrupts("log", 0);
  FarmClient farm(command.connect);
  // Of none the number is wanted all the same, as all after it are new.
  control::Log request{0, 0, std::max(command.lines, 1u), 0};
  bool is_shown = command.lines > 0;
  for (;;) {
    const auto answer = farm.ask<control::LogLines>(request, "log").first;
    // Another frontal has lines of its own, all of which are new.
    if (answer.pid != request.pid) request.after = 0;
    request.pid = answer.pid;
    for (const control::LogLine& line : answer.lines) {
      if (is_shown) print(line, command.as_json);
      request.after = line.number;
    }
    std::fflush(stdout);
    const bool is_all = answer.lines.size() < kMaxLinesAnswered;
    if (answer.is_end || (is_all && !command.follows)) return ExitStatus::kDone;
    is_shown = true;
    request.newest = kMaxLinesKept;
    request.wait_s = command.follows ? kLogWait_s : 0;
  }
}

}  // namespace graycube
