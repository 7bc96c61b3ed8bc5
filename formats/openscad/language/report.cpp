#include "formats/openscad/language/report.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

void OpenscadReport::error(int line, std::string message) {
  if (errors_.size() >= kMaxOpenscadErrors) {
    ++dropped_errors_;
    return;
  }
  errors_.push_back({line, std::move(message)});
}

void OpenscadReport::warning(int line, const std::string& message) {
  if (warnings_.size() >= kMaxOpenscadWarnings) {
    ++dropped_warnings_;
    return;
  }
  warnings_.push_back(line > 0 ? "line " + std::to_string(line) + ": " + message : message);
}

std::vector<OpenscadError> OpenscadReport::take_errors() {
  std::stable_sort(errors_.begin(), errors_.end(),
                   [](const OpenscadError& a, const OpenscadError& b) { return a.line < b.line; });
  if (dropped_errors_ > 0) {
    errors_.push_back({0, "and " + std::to_string(dropped_errors_) + " more errors"});
  }
  return std::move(errors_);
}

std::vector<std::string> OpenscadReport::take_warnings() {
  if (dropped_warnings_ > 0) {
    warnings_.push_back("and " + std::to_string(dropped_warnings_) + " more warnings");
  }
  return std::move(warnings_);
}

}  // namespace graycube
