#include "frontal/slurm/step_processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "process/program_path.hpp"
#include "process/spawn_plan.hpp"

namespace graycube::slurm {
namespace {

/// An unnamed file with the text, at its beginning; -1 if there can be none.
int file_with(const std::string& text) {
  const int file = ::memfd_create("graycube-key", MFD_CLOEXEC);
  if (file < 0) return -1;
  if (::pwrite(file, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size())) return file;
  ::close(file);
  return -1;
}

}  // namespace

// Without --overlap it would wait for CPUs that the batch script's own step holds, and with
// --immediate it fails rather than wait. A host that is lost must not end the others' steps.
std::vector<std::string> step_command(const StepSetting& setting, const std::string& host,
                                      std::uint32_t cpus) {
  return {"srun",
          "--overlap",
          "--kill-on-bad-exit=0",
          "--no-kill",
          "--immediate=10",
          "--quiet",
          "--nodes=1",
          "--ntasks=1",
          "--cpus-per-task=" + std::to_string(cpus),
          "--nodelist=" + host,
          "--job-name=graycube-host",
          setting.program,
          "join",
          setting.endpoint,
          "--key",
          "-",
          "--slots",
          std::to_string(setting.slots),
          "--name",
          host};
}

StepProcesses::~StepProcesses() {
  for (const auto& [pid, host] : running_) ::kill(pid, SIGTERM);
}

void StepProcesses::start(const std::string& host, std::uint32_t cpus) {
  std::vector<std::string> command = step_command(setting_, host, cpus);
  const auto program = program_path(command.front());
  if (!program) {
    not_started_.push_back({host, "can't be started: there is no srun in PATH"});
    return;
  }
  command.front() = *program;
  const int input = file_with(setting_.key_text + "\n");
  if (input < 0) {
    not_started_.push_back({host, std::string("can't be started: ") + std::strerror(errno)});
    return;
  }
  SpawnPlan plan;
  plan.pass_as(STDIN_FILENO, input);
  plan.open_as(STDOUT_FILENO, "/dev/null", O_WRONLY);
  plan.handle_all_as_usual();
  plan.block_no_signals();
  pid_t pid = 0;
  const int error = plan.spawn(pid, std::move(command));
  ::close(input);
  if (error != 0) {
    not_started_.push_back({host, std::string("can't be started: ") + std::strerror(error)});
  } else {
    running_[pid] = host;
  }
}

void StepProcesses::end(const std::string& host) {
  for (const auto& [pid, of_host] : running_) {
    // srun asks twice before it leaves a step whose host doesn't answer.
    if (of_host == host) ::kill(pid, SIGKILL);
  }
}

std::vector<StepEnd> StepProcesses::reap() {
  std::vector<StepEnd> ends = std::exchange(not_started_, {});
  for (auto step = running_.begin(); step != running_.end();) {
    int status = 0;
    if (::waitpid(step->first, &status, WNOHANG) != step->first) {
      ++step;
      continue;
    }
    ends.push_back({step->second, how_it_ended(status)});
    step = running_.erase(step);
  }
  return ends;
}

}  // namespace graycube::slurm
