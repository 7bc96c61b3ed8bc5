#include "cli/farm/frontal_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

#include "cli/interrupts.hpp"
#include "cli/temporary_place.hpp"
#include "process/process_state.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStartLimit{30};
constexpr std::chrono::milliseconds kPollInterval{5};
constexpr std::size_t kMaxLine = 4096;

Failure cannot_start(const std::string& why) {
  return {ExitStatus::kFailed, Problem{"farm", "graycube-frontal", why}};
}

fs::path frontal_program() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  if (error) throw cannot_start("can't find it: /proc/self/exe: " + error.message());
  fs::path program = self.parent_path() / "graycube-frontal";
  if (::access(program.c_str(), X_OK) != 0) {
    throw cannot_start("not found beside this command, in " + self.parent_path().string());
  }
  return program;
}

/// Removes the folder of a frontal's sockets, which one that was killed leaves behind.
void remove_socket_folder(const fs::path& folder) {
  std::error_code ignored;
  if (folder.parent_path() == fs::temp_directory_path(ignored) &&
      folder.filename().string().starts_with("graycube-")) {
    fs::remove_all(folder, ignored);
  }
}

}  // namespace

FrontalProcess::FrontalProcess(const std::vector<std::string>& arguments)
    : is_private_(std::find(arguments.begin(), arguments.end(), "--private") != arguments.end()) {
  if (is_private_) check_temporary_place();
  const std::string program = frontal_program().string();
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw cannot_start(std::strerror(errno));
  std::vector<std::string> command{program};
  command.insert(command.end(), arguments.begin(), arguments.end());
  SpawnPlan plan;
  plan.open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
  plan.pass_as(STDOUT_FILENO, pipe[1]);
  plan.lead_group();
  plan.handle_as_usual({SIGINT, SIGTERM, SIGPIPE});
  plan.block_no_signals();
  const int error = plan.spawn(pid_, std::move(command));
  ::close(pipe[1]);
  output_ = pipe[0];
  if (error != 0) {
    ::close(output_);
    throw cannot_start(std::strerror(error));
  }
  if (is_private_) stop_together_with(pid_);
}

FrontalProcess::~FrontalProcess() {
  stop();
  ::close(output_);
}

const std::string& FrontalProcess::wait_until_listening() {
  constexpr std::string_view prefix = "listening ";
  constexpr std::string_view page_prefix = "page ", folder_prefix = "folder ", key_prefix = "key ",
                             token_prefix = "token ";
  const auto until = std::chrono::steady_clock::now() + kStartLimit;
  std::string line;
  while (std::chrono::steady_clock::now() < until) {
    throw_if_interrupted();
    std::array<pollfd, 2> waits{{{output_, POLLIN, 0}, {wakeup_descriptor(), POLLIN, 0}}};
    if (::poll(waits.data(), waits.size(), 100) <= 0) continue;
    clear_wakeup();
    if (waits[0].revents == 0) continue;
    char c = 0;
    if (::read(output_, &c, 1) != 1) {
      // Its output has ended, so it is about to end, too; its own message tells why.
      while (!has_ended() && std::chrono::steady_clock::now() < until) {
        std::this_thread::sleep_for(kPollInterval);
      }
      throw ended();
    }
    if (c != '\n') {
      if (line.size() < kMaxLine) line += c;
    } else if (line.starts_with(prefix)) {
      endpoint_ = line.substr(prefix.size());
      return endpoint_;
    } else {
      if (line.starts_with(page_prefix)) page_ = line.substr(page_prefix.size());
      if (line.starts_with(folder_prefix)) folder_ = line.substr(folder_prefix.size());
      if (line.starts_with(token_prefix)) token_ = line.substr(token_prefix.size());
      if (line.starts_with(key_prefix)) key_file_ = line.substr(key_prefix.size());
      line.clear();
    }
  }
  throw cannot_start("it does not start to listen");
}

bool FrontalProcess::has_ended() {
  if (!has_ended_ && pid_ > 0 && ::waitpid(pid_, &wait_status_, WNOHANG) == pid_) {
    has_ended_ = true;
  }
  return has_ended_;
}

int FrontalProcess::exit_status() const {
  return WIFEXITED(wait_status_) ? WEXITSTATUS(wait_status_) : 128 + WTERMSIG(wait_status_);
}

int FrontalProcess::death_signal() const {
  return WIFSIGNALED(wait_status_) ? WTERMSIG(wait_status_) : 0;
}

bool FrontalProcess::is_stopped() const { return !has_ended_ && process_state(pid_) == 'T'; }

void FrontalProcess::kill() noexcept {
  if (!has_ended_) ::kill(pid_, SIGKILL);
}

Failure FrontalProcess::ended() const {
  const std::string how = WIFSIGNALED(wait_status_)
                              ? "killed by signal " + std::to_string(WTERMSIG(wait_status_))
                              : "ended with status " + std::to_string(exit_status());
  return cannot_start(how);
}

void FrontalProcess::check_running() {
  if (has_ended()) throw ended();
}

void FrontalProcess::request_stop() noexcept {
  if (has_ended() || is_stop_requested_) return;
  is_stop_requested_ = true;
  ::kill(pid_, SIGTERM);
}

void FrontalProcess::stop() noexcept {
  request_stop();
  if (is_private_) stop_together_with(0);
  const auto until = std::chrono::steady_clock::now() + kStopGrace;
  while (!has_ended() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(kPollInterval);
  }
  if (has_ended_ && !WIFSIGNALED(wait_status_)) return;
  // Its nodes are in its process group; what it could not remove itself is removed here.
  ::kill(-pid_, SIGKILL);
  if (!has_ended_) wait_status_ = wait_for_end(pid_);
  has_ended_ = true;
  remove_socket_folder(folder_);
}

}  // namespace graycube
