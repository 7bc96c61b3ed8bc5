// One line at the end of a terminal that is drawn again and again.
#pragma once

#include <cstdio>
#include <string>

namespace graycube {

/// Removes its line when it ends. Interrupts remove it, too.
class TerminalLine {
 public:
  explicit TerminalLine(std::FILE* stream) : stream_(stream) {}
  ~TerminalLine() { clear(); }
  TerminalLine(const TerminalLine&) = delete;
  TerminalLine& operator=(const TerminalLine&) = delete;

  /// Draws the line, which must not be longer than the terminal is wide, in place of the last.
  void draw(const std::string& line);
  /// Removes the line, so that something else may be printed.
  void clear();

 private:
  std::FILE* stream_;
  bool is_open_ = false;
};

}  // namespace graycube
