// One run of the program openscad, from its start to its end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace graycube {

struct OpenscadRun {
  /// The program's path, and its arguments.
  std::vector<std::string> words;
  /// Its messages go to this file.
  std::filesystem::path log;
  /// The most seconds that each part may take.
  int most_seconds = 0;
  /// Called every now and then with the number of parts that it has begun to export.
  std::function<void(std::size_t)> on_look{};
};

/// Begins a line of the log wherever the program begins to export a part (openscad.cc, with
/// --animate).
inline constexpr const char* kOpenscadPartMark = "Exporting ";

/// Runs the program and returns its wait status (waitpid(2)); nothing if a part's time was up and
/// it was killed. An interrupt kills it, too, and is thrown as a Failure; so is that it can't be
/// started.
std::optional<int> run_openscad(const OpenscadRun& run);

}  // namespace graycube
