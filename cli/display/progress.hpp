// A render's progress for people: one line redrawn on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/display/terminal_line.hpp"
#include "proto/messages.hpp"

namespace graycube {

/// "30 of 64 parts of the picture are final": parts are tiles, final when no ray of theirs is left.
std::string final_parts_text(std::uint32_t final_parts, std::uint32_t parts);

/// "2 checks whether all is done": these are the rounds of the token.
std::string end_checks_text(std::uint32_t rounds);

/// "rendering 47 %, 3 s left, 30 of 64 parts of the picture are final, 2 checks whether all is
/// done": as much of it as is known.
std::string progress_text(const control::Progress& progress);

/// Nearly the same behind a bar, for a terminal of so many columns.
std::string progress_bar(const control::Progress& progress, std::size_t columns);

/// A duration such as "850 ms", "3.4 s", "12 s", "3 min 20 s" or "2 h 5 min".
std::string duration_text(double seconds);

class ProgressDisplay {
 public:
  /// Shows nothing when `is_quiet`; `as_json`: each progress is a line of JSON, a `progress`
  /// message.
  ProgressDisplay(std::FILE* stream, bool is_quiet, bool as_json = false);
  /// Shows progress if it is time to, or if the state or the number of token rounds has changed.
  void show(const control::Progress& progress);
  /// Removes the terminal's line, so that something else may be printed.
  void clear() { line_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::FILE* stream_;
  bool is_quiet_, as_json_, is_terminal_;
  TerminalLine line_;
  std::optional<control::Progress> shown_;
  Clock::time_point shown_at_{};
};

}  // namespace graycube
