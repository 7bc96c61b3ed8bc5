// Real processes, in folders of their own: run a command, and look at its output and at the files
// that it leaves behind.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "process/temporary_folder.hpp"

namespace graycube {

using Arguments = std::vector<std::string>;
using namespace std::chrono_literals;

/// A process's end, and its output.
struct Outcome {
  /// The exit status; 128 + the signal's number if that ended it.
  int status = -1;
  std::string out, err;
  double wall_s = 0;
};

/// The lines of a text, without their ends.
std::vector<std::string> lines_of(const std::string& text);

/// One of the scenes that come with the project.
std::filesystem::path scene_file(const std::string& name);

std::string file_bytes(const std::filesystem::path& path);

/// The path of an installed program, if there is one.
std::optional<std::string> find_program(const std::string& name);

class Sandbox;

/// A process that a test has started; killed at the end if it still runs then.
class Running {
 public:
  Running(Running&&) noexcept;
  Running& operator=(Running&&) = delete;
  ~Running();

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  bool has_ended();
  /// Its output so far.
  std::string out() const;
  std::string err() const;
  /// Waits until its output contains `text`; fails the test when it ends or the time is up before.
  void wait_for(const std::string& text, std::chrono::milliseconds limit = 30s);
  /// Waits for its end; fails the test when that does not come in time.
  Outcome wait(std::chrono::milliseconds limit = 60s);

 private:
  friend class Sandbox;
  Running() = default;
  pid_t pid_ = -1;
  int wait_status_ = 0;
  std::filesystem::path out_, err_;
  std::chrono::steady_clock::time_point started_{};
};

/// Folders for a test's files, temporary files and sockets, and a mark in the environment of all
/// processes started in it, by which they are found again.
class Sandbox {
 public:
  Sandbox();
  /// Kills what is left of the processes that were started in it.
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  /// The current folder of the processes that are started.
  const std::filesystem::path& work() const { return work_; }
  std::filesystem::path operator/(const std::string& name) const { return work_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  nlohmann::json json(const std::string& name) const;

  /// Starts `graycube` with these arguments.
  Running start(const Arguments& arguments);
  /// Starts any other program, by its path.
  Running start_program(const std::string& path, const Arguments& arguments);
  /// Runs `graycube` to its end.
  Outcome run(const Arguments& arguments, std::chrono::milliseconds limit = 60s);
  /// Runs any other program, by its path.
  Outcome run_program(const std::string& path, const Arguments& arguments,
                      std::chrono::milliseconds limit = 60s);

  /// Command lines of processes started here, directly or not, that still run.
  std::vector<std::string> processes() const;
  /// Files, sockets and folders left in the folders for temporary files and sockets.
  std::vector<std::string> temporary_files() const;
  /// Names in the current folder, sorted.
  std::vector<std::string> files() const;

 private:
  TemporaryFolder root_{"gc-"};
  std::filesystem::path work_, temporary_, runtime_, logs_;
  int started_ = 0;
};

}  // namespace graycube
