// Collects the errors and warnings of the parts of the OpenSCAD reader.
#pragma once

#include <string>
#include <vector>

#include "formats/openscad/language/limits.hpp"

namespace graycube {

/// `line` counts from 1; 0 stands for the whole file.
struct OpenscadError {
  int line = 0;
  std::string message;
};

/// Keeps the first kMaxOpenscadErrors errors and kMaxOpenscadWarnings warnings, and counts the
/// rest.
class OpenscadReport {
 public:
  /// Line 0 stands for the whole file.
  void error(int line, std::string message);
  void warning(int line, const std::string& message);
  bool has_errors() const { return !errors_.empty(); }

  /// The errors by line, those of one line in the order in which they were found; then, with line
  /// 0, how many more there were.
  std::vector<OpenscadError> take_errors();
  std::vector<std::string> take_warnings();

 private:
  std::vector<OpenscadError> errors_;
  std::vector<std::string> warnings_;
  std::size_t dropped_errors_ = 0;
  std::size_t dropped_warnings_ = 0;
};

}  // namespace graycube
