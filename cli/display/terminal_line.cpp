#include "cli/display/terminal_line.hpp"

#include "cli/interrupts.hpp"

namespace graycube {

// ESC [ K erases the rest of the line.

void TerminalLine::draw(const std::string& line) {
  std::fputs(("\r" + line + "\x1b[K").c_str(), stream_);
  std::fflush(stream_);
  is_open_ = true;
  note_terminal_line(true);
}

void TerminalLine::clear() {
  if (!is_open_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
  is_open_ = false;
  note_terminal_line(false);
}

}  // namespace graycube
