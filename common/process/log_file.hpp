// A file to which lines are appended, by several processes too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace graycube {

class LogFile {
 public:
  /// Opens the file, or makes it; only its owner may read it. Appends a line with the text `first`:
  /// what can't be written is found at once. Throws std::runtime_error, which says why.
  LogFile(const std::filesystem::path& file, std::string_view first);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Appends a line that has its end. Returns why that failed, the first time that it does, else
  /// nothing. Every line is tried, so that the log goes on once the disk has room again.
  std::string append(std::string_view line);

 private:
  std::filesystem::path file_;
  int descriptor_;
  /// A part of a line was written: the next one must not go on with it.
  bool is_in_line_ = false;
  bool has_failed_ = false;
};

}  // namespace graycube
