#include "cli/display/wait_display.hpp"

#include <unistd.h>

#include "cli/display/progress.hpp"

namespace graycube {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFirstOnTerminal{500}, kRedrawInterval{100}, kFirstLine{5000};

}  // namespace

WaitDisplay::WaitDisplay(std::FILE* stream, bool is_quiet)
    : stream_(stream),
      is_quiet_(is_quiet),
      is_terminal_(::isatty(::fileno(stream)) == 1),
      line_(stream),
      next_(is_terminal_ ? kFirstOnTerminal : kFirstLine) {}

void WaitDisplay::show(const std::string& what) {
  const Clock::duration waited = Clock::now() - started_;
  if (is_quiet_ || waited < next_) return;
  next_ = is_terminal_ ? waited + Clock::duration(kRedrawInterval) : 2 * next_;
  const double seconds = std::chrono::duration<double>(waited).count();
  const std::string text = what + ": " + duration_text(seconds);
  if (is_terminal_) return line_.draw(text);
  std::fputs(("graycube: " + text + " so far\n").c_str(), stream_);
  std::fflush(stream_);
}

}  // namespace graycube
