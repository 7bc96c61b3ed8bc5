// What another program is at while the command waits for it: one line redrawn on a terminal; lines
// ever further apart elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "cli/display/terminal_line.hpp"

namespace graycube {

class WaitDisplay {
 public:
  /// Shows nothing when `is_quiet`. The wait begins now.
  WaitDisplay(std::FILE* stream, bool is_quiet);
  /// Shows what is being done, such as "openscad: part 2 of 3", and for how long this wait has
  /// lasted, if it is time to. Short waits are never shown.
  void show(const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* stream_;
  bool is_quiet_, is_terminal_;
  TerminalLine line_;
  Clock::time_point started_ = Clock::now();
  /// The wait's length at which the next text is due.
  Clock::duration next_;
};

}  // namespace graycube
