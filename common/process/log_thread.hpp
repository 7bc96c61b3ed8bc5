// Writes a log's lines to a file and to standard error, in a thread of its own: neither a slow disk
// nor a terminal that takes nothing holds anybody up.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "process/log_file.hpp"

namespace graycube {

/// Lines that may wait to be written. Further ones are dropped, and counted.
inline constexpr std::size_t kMaxWaitingLines = 4096;

class LogThread {
 public:
  /// `file` is empty where there is none. A line with the text `first` is written to it at once;
  /// throws std::runtime_error, which says why, if that can't be done.
  LogThread(const std::filesystem::path& file, std::string_view first);
  /// Writes what waits, as far as standard error takes it.
  ~LogThread();
  LogThread(const LogThread&) = delete;
  LogThread& operator=(const LogThread&) = delete;

  /// Any thread may call it. `is_shown`: on standard error, too.
  void write(double unix_s, std::string_view text, bool is_shown);

 private:
  struct Line {
    std::string text;
    bool is_shown = false;
  };
  void run();
  void write(const Line& line);
  void show(std::string_view line);

  std::unique_ptr<LogFile> file_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Line> lines_;
  std::size_t dropped_ = 0;
  bool is_ending_ = false;
  /// Of the thread alone: standard error takes nothing at the moment.
  bool is_stuck_ = false;
  std::thread thread_;
};

}  // namespace graycube
