// A graycube-frontal that this command starts, and stops.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/failure.hpp"

namespace graycube {

/// If a frontal has not ended so long after it was asked to, it is killed with its nodes.
inline constexpr std::chrono::milliseconds kStopGrace{3000};

class FrontalProcess {
 public:
  /// Starts the graycube-frontal beside this command, in a process group of its own: a terminal's
  /// Ctrl-C reaches only the command, which then ends things in order. Throws a Failure.
  explicit FrontalProcess(const std::vector<std::string>& arguments);
  /// Stops it.
  ~FrontalProcess();
  FrontalProcess(const FrontalProcess&) = delete;
  FrontalProcess& operator=(const FrontalProcess&) = delete;

  /// Waits until it tells its endpoint, and returns that. Throws a Failure when it ends instead, or
  /// when an interrupt comes.
  const std::string& wait_until_listening();
  /// The address of its web page, once it listens; empty when there is none.
  const std::string& page() const { return page_; }
  /// What the page shows to be allowed to change something.
  const std::string& token() const { return token_; }
  /// The file of its key; empty when clients need none.
  const std::string& key_file() const { return key_file_; }
  /// Throws a Failure when it has ended.
  void check_running();
  bool has_ended();
  /// Its exit status, or 128 + the number of the signal that ended it; it must have ended.
  int exit_status() const;
  /// The signal that ended it, 0 if it ended by itself; it must have ended.
  int death_signal() const;

  /// Whether a signal has stopped it, so that it does nothing until another lets it go on.
  bool is_stopped() const;
  /// Kills it, with its nodes.
  void kill() noexcept;
  /// Asks it to stop, without waiting.
  void request_stop() noexcept;
  /// Stops it and waits until it has ended; after the grace it is killed.
  void stop() noexcept;

 private:
  Failure ended() const;

  pid_t pid_ = -1;
  int output_ = -1;
  bool has_ended_ = false, is_stop_requested_ = false, is_private_ = false;
  int wait_status_ = 0;
  std::string endpoint_, page_, folder_, token_, key_file_;
};

}  // namespace graycube
