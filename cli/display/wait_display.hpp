// What another program is at while the command waits for it: one line redrawn on a terminal; lines
// ever further apart elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace graycube {

class WaitDisplay {
 public:
  /// Shows nothing when `is_quiet`. The wait begins now.
  WaitDisplay(std::FILE* stream, bool is_quiet);
  ~WaitDisplay();
  WaitDisplay(const WaitDisplay&) = delete;
  WaitDisplay& operator=(const WaitDisplay&) = delete;

  /// Shows what is being done, such as "openscad: part 2 of 3", and for how long this wait has
  /// lasted, if it is time to. Short waits are never shown.
  void show(const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  void clear();

  std::FILE* stream_;
  bool is_quiet_, is_terminal_;
  bool is_line_open_ = false;
  Clock::time_point started_ = Clock::now();
  /// The wait's length at which the next text is due.
  Clock::duration next_;
};

}  // namespace graycube
