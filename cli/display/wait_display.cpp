#include "cli/display/wait_display.hpp"

#include <unistd.h>

#include "cli/display/progress.hpp"
#include "cli/interrupts.hpp"

namespace graycube {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFirstOnTerminal{500}, kRedrawInterval{100}, kFirstLine{5000};

}  // namespace

WaitDisplay::WaitDisplay(std::FILE* stream, bool is_quiet)
    : stream_(stream),
      is_quiet_(is_quiet),
      is_terminal_(::isatty(::fileno(stream)) == 1),
      next_(is_terminal_ ? kFirstOnTerminal : kFirstLine) {}

WaitDisplay::~WaitDisplay() { clear(); }

void WaitDisplay::show(const std::string& what) {
  const Clock::duration waited = Clock::now() - started_;
  if (is_quiet_ || waited < next_) return;
  next_ = is_terminal_ ? waited + Clock::duration(kRedrawInterval) : 2 * next_;
  const double seconds = std::chrono::duration<double>(waited).count();
  const std::string line = what + ": " + duration_text(seconds);
  // ESC [ K erases the rest of the line.
  const std::string text =
      is_terminal_ ? "\r" + line + "\x1b[K" : "graycube: " + line + " so far\n";
  std::fwrite(text.data(), 1, text.size(), stream_);
  std::fflush(stream_);
  is_line_open_ = is_terminal_;
  note_terminal_line(is_line_open_);
}

void WaitDisplay::clear() {
  if (!is_line_open_) return;
  std::fputs("\r\x1b[K", stream_);
  std::fflush(stream_);
  is_line_open_ = false;
  note_terminal_line(false);
}

}  // namespace graycube
