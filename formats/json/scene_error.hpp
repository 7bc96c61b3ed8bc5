// One error of a scene file, and its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace graycube {

/// Errors beyond so many are only counted.
inline constexpr std::size_t kMaxReportedErrors = 100;

struct SceneError {
  /// A JSON pointer (RFC 6901) to the value; empty for the whole file.
  std::string pointer;
  /// Tells what was expected and what was found.
  std::string message;
  /// The place in the text at which that value begins, from 1; 0 when there is no such place.
  std::uint64_t line = 0, column = 0;
};

}  // namespace graycube
