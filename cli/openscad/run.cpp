#include "cli/openscad/run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <string_view>

#include "cli/failure.hpp"
#include "cli/interrupts.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

using Clock = std::chrono::steady_clock;

/// Milliseconds between looks whether the process has ended, if the system can't tell that.
constexpr int kLookMs = 20;

pid_t start(const OpenscadRun& run) {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  SpawnPlan plan;
  plan.open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
  plan.open_as(STDOUT_FILENO, "/dev/null", O_WRONLY);
  plan.open_as(STDERR_FILENO, run.log.c_str(), kWrite);
  plan.handle_as_usual({SIGPIPE});
  pid_t pid = -1;
  const int error = plan.spawn(pid, run.words);
  if (error != 0) {
    throw Failure(ExitStatus::kFailed,
                  Problem{"openscad", run.words.front(), std::strerror(error)});
  }
  return pid;
}

void reap(pid_t pid) {
  ::kill(pid, SIGKILL);
  wait_for_end(pid);
}

/// Counts the parts in a log that grows.
class PartCount {
 public:
  explicit PartCount(std::filesystem::path log) : log_(std::move(log)) {}

  std::size_t look() {
    std::ifstream file(log_, std::ios::binary);
    file.seekg(read_);
    for (std::string line; std::getline(file, line) && !file.eof();) {
      read_ += static_cast<std::streamoff>(line.size()) + 1;
      if (line.starts_with(kOpenscadPartMark)) ++count_;
    }
    return count_;
  }

 private:
  std::filesystem::path log_;
  std::streamoff read_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

std::optional<int> run_openscad(const OpenscadRun& run) {
  const pid_t pid = start(run);
  PartCount parts(run.log);
  std::size_t begun = 0;
  const auto most = std::chrono::seconds(run.most_seconds);
  auto deadline = Clock::now() + most;
  for (;;) {
    int status = 0;
    if (::waitpid(pid, &status, WNOHANG) == pid) return status;
    if (is_interrupted()) {
      reap(pid);
      throw_if_interrupted();
    }
    const std::size_t now_begun = parts.look();
    if (now_begun > begun) deadline = Clock::now() + most;
    begun = now_begun;
    if (Clock::now() >= deadline) {
      reap(pid);
      return std::nullopt;
    }
    if (run.on_look) run.on_look(begun);
    ::poll(nullptr, 0, kLookMs);
  }
}

}  // namespace graycube
