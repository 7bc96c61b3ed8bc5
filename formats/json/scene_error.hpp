// One error of a scene file, and its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace graycube {

/// Further errors are only counted.
inline constexpr std::size_t kMaxReportedErrors = 100;

struct SceneError {
  /// RFC 6901; empty for the whole file.
  std::string pointer;
  /// What was expected and what was found.
  std::string message;
  /// Where that value begins in the text, from 1; 0 when there is no such place.
  std::uint64_t line = 0, column = 0;
};

}  // namespace graycube
