// Collects the errors and warnings of the parts of the OpenSCAD reader.
#pragma once

#include <string>
#include <vector>

#include "formats/openscad/language/limits.hpp"
#include "formats/report/import_warnings.hpp"

namespace graycube {

/// `line` counts from 1; 0 stands for the whole file.
struct OpenscadError {
  int line = 0;
  std::string message;
};

/// Keeps the first kMaxOpenscadErrors errors and kMaxOpenscadWarnings kinds of warnings, and counts
/// the rest.
class OpenscadReport {
 public:
  /// Line 0 stands for the whole file.
  void error(int line, std::string message);
  /// A warning; those with the same message are one, with a count.
  void warning(int line, const std::string& message);
  /// A warning of a kind that other messages have in common.
  void warning(const std::string& kind, int line, const std::string& message);
  /// The same for a part that is missing in the scene because of it.
  void leave_out(const std::string& kind, int line, const std::string& message);
  bool has_errors() const { return !errors_.empty(); }

  /// The errors by line, those of one line in the order in which they were found; then, with line
  /// 0, how many more there were.
  std::vector<OpenscadError> take_errors();
  /// `where` is "line N" or empty.
  std::vector<ImportWarning> take_warnings();

 private:
  std::vector<OpenscadError> errors_;
  ImportWarnings warnings_{kMaxOpenscadWarnings};
  std::size_t dropped_errors_ = 0;
};

}  // namespace graycube
