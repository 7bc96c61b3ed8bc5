#include "frontal/node_processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace graycube {
namespace {

std::string description(int status) {
  if (WIFSIGNALED(status)) return "killed by signal " + std::to_string(WTERMSIG(status));
  return "exited with status " + std::to_string(WEXITSTATUS(status));
}

/// The child starts with default signal handling and nothing blocked, whatever the frontal has set.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    ::posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnAttributes() { ::posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

}  // namespace

NodeProcesses::NodeProcesses(std::filesystem::path program, std::filesystem::path folder,
                             std::uint32_t threads)
    : program_(std::move(program)), folder_(std::move(folder)), threads_(threads) {}

NodeProcesses::~NodeProcesses() {
  for (const auto& [pid, child] : running_) ::kill(pid, SIGKILL);
  for (const auto& [pid, child] : running_) ::waitpid(pid, nullptr, 0);
}

void NodeProcesses::start(Rank rank, std::uint32_t incarnation, const std::string& frontal) {
  const std::string number = std::to_string(rank.value);
  std::vector<std::string> arguments{
      program_.string(), "--rank",    number,
      "--incarnation",   std::to_string(incarnation),
      "--threads",       std::to_string(threads_),
      "--frontal",       frontal,
      "--inbox",         "ipc://" + (folder_ / ("node-" + number)).string()};
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  const SpawnAttributes attributes;
  pid_t pid = 0;
  const int error =
      ::posix_spawn(&pid, program_.c_str(), nullptr, attributes.get(), argv.data(), environ);
  if (error != 0) throw std::system_error(error, std::generic_category(), program_.string());
  running_[pid] = {rank, incarnation};
}

void NodeProcesses::end(Rank rank, std::uint32_t incarnation) {
  for (const auto& [pid, child] : running_) {
    if (child.rank == rank && child.incarnation == incarnation) ::kill(pid, SIGKILL);
  }
}

std::vector<NodeExit> NodeProcesses::reap() {
  std::vector<NodeExit> exits;
  for (;;) {
    // They are the only children here; asked one by one, each message would cost as many calls as there are nodes.
    int status = 0;
    const pid_t pid = ::waitpid(-1, &status, WNOHANG);
    if (pid <= 0) return exits;
    const auto child = running_.find(pid);
    if (child == running_.end()) continue;
    exits.push_back({child->second.rank, child->second.incarnation, description(status)});
    running_.erase(child);
  }
}

}  // namespace graycube
