// Files in a folder of a test's own.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "process/temporary_folder.hpp"

namespace graycube {

inline std::filesystem::path write_file(const std::filesystem::path& path,
                                        const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace graycube
