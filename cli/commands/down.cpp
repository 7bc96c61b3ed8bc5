// graycube down: stops a farm, and waits until it has gone.
#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <thread>

#include "cli/commands/commands.hpp"
#include "cli/farm/client.hpp"
#include "cli/farm/listener.hpp"

namespace graycube {
namespace {

constexpr std::chrono::seconds kDownLimit{20};
constexpr std::chrono::milliseconds kPollInterval{10};

bool has_gone(const std::string& endpoint, pid_t process) {
  if (find_listener(endpoint).is_there) return false;
  return process <= 0 || (::kill(process, 0) != 0 && errno == ESRCH);
}

}  // namespace

ExitStatus run(const DownCommand& command) {
  const pid_t process = find_listener(command.connect.endpoint).process;
  {
    FarmClient farm(command.connect);
    farm.expect_end();
    farm.ask<control::Bye>(control::Down{}, "down");
  }
  const auto until = std::chrono::steady_clock::now() + kDownLimit;
  while (!has_gone(command.connect.endpoint, process)) {
    if (std::chrono::steady_clock::now() > until) {
      throw Failure(ExitStatus::kFailed,
                    Problem{"farm", command.connect.endpoint, "it was told to stop, and has not"});
    }
    std::this_thread::sleep_for(kPollInterval);
  }
  remove_stale_socket(command.connect.endpoint);
  std::printf("the farm at %s has stopped\n", command.connect.endpoint.c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube
