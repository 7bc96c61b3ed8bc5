#include "process/spawn_plan.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace graycube {
namespace {

constexpr mode_t kOwnFile = 0600;

/// Pointers to the texts, as exec takes them; the texts must outlive these.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  return pointers;
}

}  // namespace

SpawnPlan::SpawnPlan() {
  ::posix_spawn_file_actions_init(&actions_);
  ::posix_spawnattr_init(&attributes_);
}

SpawnPlan::~SpawnPlan() {
  ::posix_spawnattr_destroy(&attributes_);
  ::posix_spawn_file_actions_destroy(&actions_);
}

void SpawnPlan::open_as(int descriptor, const char* path, int flags) {
  ::posix_spawn_file_actions_addopen(&actions_, descriptor, path, flags, kOwnFile);
}

void SpawnPlan::pass_as(int descriptor, int own) {
  ::posix_spawn_file_actions_adddup2(&actions_, own, descriptor);
}

void SpawnPlan::handle_as_usual(std::initializer_list<int> signals) {
  sigset_t set;
  ::sigemptyset(&set);
  for (const int s : signals) ::sigaddset(&set, s);
  ::posix_spawnattr_setsigdefault(&attributes_, &set);
  flags_ |= POSIX_SPAWN_SETSIGDEF;
}

void SpawnPlan::handle_all_as_usual() {
  sigset_t all;
  ::sigfillset(&all);
  ::posix_spawnattr_setsigdefault(&attributes_, &all);
  flags_ |= POSIX_SPAWN_SETSIGDEF;
}

void SpawnPlan::block_no_signals() {
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setsigmask(&attributes_, &none);
  flags_ |= POSIX_SPAWN_SETSIGMASK;
}

void SpawnPlan::lead_group() {
  ::posix_spawnattr_setpgroup(&attributes_, 0);
  flags_ |= POSIX_SPAWN_SETPGROUP;
}

int SpawnPlan::spawn(pid_t& pid, std::vector<std::string> command,
                     std::vector<std::string> variables) {
  ::posix_spawnattr_setflags(&attributes_, flags_);
  std::vector<char*> arguments = pointers_to(command);
  arguments.push_back(nullptr);
  std::vector<char*> environment = pointers_to(variables);
  for (char** variable = environ; *variable != nullptr; ++variable)
    environment.push_back(*variable);
  environment.push_back(nullptr);
  return ::posix_spawn(&pid, arguments.front(), &actions_, &attributes_, arguments.data(),
                       environment.data());
}

int wait_for_end(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) == -1 && errno == EINTR) {
  }
  return status;
}

std::string how_it_ended(int wait_status) {
  if (WIFSIGNALED(wait_status)) return "killed by signal " + std::to_string(WTERMSIG(wait_status));
  return "exited with status " + std::to_string(WEXITSTATUS(wait_status));
}

}  // namespace graycube
