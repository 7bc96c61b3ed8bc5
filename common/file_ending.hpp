// The endings of file names, in which capitals count as small letters.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace graycube {

/// The part of the name from its last dot on, in small letters; empty if there is none.
inline std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

/// `ending` is in small letters, with its dot.
inline bool has_ending(const std::filesystem::path& path, std::string_view ending) {
  return ending_of(path) == ending;
}

}  // namespace graycube
