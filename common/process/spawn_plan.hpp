// Starts a program as a child of this process, and waits for its end.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace graycube {

/// posix_spawn's two sets of instructions. A child inherits everything from its parent, except for
/// what is set here.
class SpawnPlan {
 public:
  SpawnPlan();
  ~SpawnPlan();
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  /// Makes a descriptor of the child a file, opened with these flags (open(2)); the path must
  /// outlive the plan.
  void open_as(int descriptor, const char* path, int flags);
  /// Makes a descriptor of the child a copy of `own`, one of this process.
  void pass_as(int descriptor, int own);
  /// Gives these signals their default actions in the child, whatever this process does with them.
  void handle_as_usual(std::initializer_list<int> signals);
  void handle_all_as_usual();
  void block_no_signals();
  /// Makes the child the leader of its own process group.
  void lead_group();

  /// Starts the program whose path is `command.front()`, with `variables`, "NAME=VALUE", before
  /// this process's own. Returns 0 and sets `pid`, or returns the error (errno's number).
  [[nodiscard]] int spawn(pid_t& pid, std::vector<std::string> command,
                          std::vector<std::string> variables = {});

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
  short flags_ = 0;
};

/// Waits until the child has ended, whatever signals arrive meanwhile, and returns its wait status
/// (waitpid(2)); 0 if there is no such child.
int wait_for_end(pid_t pid);

/// A wait status for people: "killed by signal 9", "exited with status 1".
std::string how_it_ended(int wait_status);

}  // namespace graycube
