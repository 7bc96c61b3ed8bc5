#include "process/command_output.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "process/program_path.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

CommandOutput command_output(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  const auto path = program_path(words.front());
  if (!path) fail(ENOENT, words.front());
  words.front() = *path;
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) fail(errno, command.front());
  SpawnPlan plan;
  plan.open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
  plan.pass_as(STDOUT_FILENO, pipe[1]);
  plan.handle_all_as_usual();
  plan.block_no_signals();
  pid_t pid = 0;
  const int error = plan.spawn(pid, std::move(words));
  ::close(pipe[1]);
  if (error != 0) {
    ::close(pipe[0]);
    fail(error, command.front());
  }
  CommandOutput output;
  std::array<char, 4096> part;
  for (;;) {
    const ssize_t got = ::read(pipe[0], part.data(), part.size());
    if (got > 0) output.text.append(part.data(), static_cast<std::size_t>(got));
    if (output.text.size() > kMaxCommandOutput) ::kill(pid, SIGKILL);
    if (got == 0 || (got < 0 && errno != EINTR)) break;
  }
  ::close(pipe[0]);
  output.wait_status = wait_for_end(pid);
  return output;
}

}  // namespace graycube
