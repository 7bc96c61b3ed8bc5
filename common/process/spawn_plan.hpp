// How a program is started as a child of this process.
#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <initializer_list>
#include <string>
#include <vector>

namespace graycube {

/// posix_spawn's two sets of instructions. A child has what its parent has, but for what is said
/// here.
class SpawnPlan {
 public:
  SpawnPlan();
  ~SpawnPlan();
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  /// The child's descriptor is a file, opened with these flags (open(2)); the path must outlive the
  /// plan.
  void open_as(int descriptor, const char* path, int flags);
  /// The child's descriptor is one of this process.
  void pass_as(int descriptor, int own);
  /// Signals that the child handles as is usual, whatever this process does with them.
  void handle_as_usual(std::initializer_list<int> signals);
  void handle_all_as_usual();
  void block_no_signals();
  /// The child leads a process group of its own.
  void lead_group();

  /// Starts a program, `command.front()` by its path, with further variables, "NAME=VALUE", before
  /// this process's own. 0 and its id in `pid`, or the error (errno's number).
  [[nodiscard]] int spawn(pid_t& pid, std::vector<std::string> command,
                          std::vector<std::string> variables = {});

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
  short flags_ = 0;
};

}  // namespace graycube
