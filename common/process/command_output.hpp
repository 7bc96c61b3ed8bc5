// Runs a program to its end, and takes what it writes.
#pragma once

#include <string>
#include <vector>

namespace graycube {

/// The most bytes that are taken; a program that writes more is killed.
inline constexpr std::size_t kMaxCommandOutput = std::size_t{4} << 20;

struct CommandOutput {
  /// Of its standard output.
  std::string text;
  /// As waitpid(2) tells it; 0 if it ended well.
  int wait_status = 0;
};

/// Runs the program, which is looked for in PATH, with nothing to read. Throws std::system_error
/// when it can't be started.
CommandOutput command_output(const std::vector<std::string>& command);

}  // namespace graycube
